// Comparison: video made again against the recording of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/video/spoke.hpp"
#include "server/replay/recorded_exercise.hpp"

namespace skerry::server {

struct ComparisonResult {
  std::uint64_t made = 0;       // spokes
  std::uint64_t compared = 0;   // with recorded ones, byte by byte
  std::uint64_t different = 0;  // of these
  std::uint64_t missing = 0;    // recorded, but never made again
  std::uint64_t hashed = 0;     // under checkpoints
  std::uint64_t checkpoints = 0;
  std::uint64_t checkpoints_wrong = 0;
  std::string first_difference;  // where
  // SHA-256 of all spokes made, radar by radar and view by view, hexadecimal.
  std::string sha256;

  bool is_identical() const { return different + missing + checkpoints_wrong == 0; }
  // Whether there was no recorded video to compare with.
  bool is_empty() const { return compared + hashed == 0; }
};

// Spokes of a radar and view must come in the order of their sequence numbers.
class Comparison {
 public:
  // Both must outlive it.
  Comparison(const recording::RecordingReader& reader, const RecordedExercise& exercise);
  ~Comparison();

  void add(const Spoke& spoke);
  // When all have come.
  ComparisonResult finish();

 private:
  struct View;
  View& view_of(std::uint32_t radar, std::uint32_t number);
  void compare(View& view, const std::string& bytes, std::uint64_t sequence);
  void hash(View& view, const std::string& bytes, std::uint64_t sequence);
  void note(const std::string& what);

  const recording::RecordingReader& reader_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<View>> views_;
  wire::Spoke message_;
  std::string bytes_;
  ComparisonResult result_;
};

}  // namespace skerry::server
