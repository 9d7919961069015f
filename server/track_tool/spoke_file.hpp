// SpokeFile: the spokes of a recording, or of a capture of a real radar, in the order of time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Gets the share done, 0 .. 1, and what is being done: "reading the capture".
using ReadProgress = std::function<void(double, const char*)>;

// Which spokes are wanted.  Without numbers: of the first radar that has spokes, and its first
// view.
struct SpokeChoice {
  std::optional<std::uint32_t> radar = {}, view = {};
  // Positions (protocol/recording/position.hpp); empty: its begin, its end.
  std::string from = {}, until = {};
};

struct SpokesTaken {
  std::uint64_t spokes = 0;
  std::uint64_t refused = 0;  // messages that are no spoke
  std::uint64_t chunks = 0;   // damaged, passed over
};

// What begins as a recording, or is called .mcap, is read as one; anything else is a capture (pcap
// or pcapng, by gzip or not), which is imported into a temporary recording first: that takes about
// the capture's size in the system's temporary folder, and is gone once it is open.  Memory: the
// chunks that hold the present time (ItemCursor).
//
// Thread: one at a time.
class SpokeFile {
 public:
  // Error: std::runtime_error that names the file: it cannot be read, is neither, has no radar.
  explicit SpokeFile(const std::string& path, const ReadProgress& progress = {});

  const recording::RecordingReader& reader() const { return *reader_; }
  // "FILE: what is wrong; what can be read is used": of damaged files.
  const std::vector<std::string>& warnings() const { return warnings_; }

  struct View {
    std::uint32_t radar = 0, view = 0;
  };
  // Error: std::runtime_error, says which there are.
  View chosen(const SpokeChoice& choice) const;
  // The recording's, with that radar alone.
  wire::Hello hello(std::uint32_t radar) const;
  // As the recording tells it; 0 if it does not.
  double beam_deg(std::uint32_t radar) const;

  // Calls `take` with each of them.  Error: std::runtime_error: there is no such view or position,
  // or no spoke in that part.
  SpokesTaken each_spoke(const SpokeChoice& choice, const std::function<void(const Spoke&)>& take,
                         const ReadProgress& progress = {}) const;

 private:
  void open_recording(const std::string& path, const ReadProgress& progress);
  void open_capture(const ReadProgress& progress);
  UtcTime position(const std::string& text, const char* option) const;

  std::string path_;
  std::optional<recording::RecordingReader> reader_;
  std::vector<std::string> warnings_;
};

}  // namespace skerry::server
