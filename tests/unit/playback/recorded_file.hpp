// A small recording for tests: spokes whose cells tell which they are, and what stands beside them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::server {

// 2026-11-22 10:00 UTC.
inline constexpr UtcTime kRecordedAt{std::chrono::seconds(1'795'341'600)};

struct RecordedScene {
  std::uint32_t spokes_per_turn = 256;
  std::uint32_t cells = 128;
  std::uint32_t turns = 4;
  Duration turn = std::chrono::seconds(2);  // 30 rpm
  std::vector<std::uint32_t> radars = {0};
  std::vector<std::uint32_t> views = {0};
  std::uint32_t first_scan = 1000;
  std::uint64_t first_sequence = 5'000'000;
  bool hello = true, settings = true, own_ship = true, traffic = true;
  bool exercise = false;  // recorded_exercise() once a second
  // Changes a spoke before it is written; false: it is left out.
  std::function<bool(Spoke&)> change = {};
  std::vector<std::pair<Duration, std::string>> marks = {};
  std::string mark_kind = {};  // of all of them
};

// The n-th spoke of a radar and view as the scene has it.
Spoke recorded_spoke(const RecordedScene& scene, std::uint32_t radar, std::uint32_t view,
                     std::uint64_t n);

// The exercise at a second of the recording: its clock goes twice as fast, and the places of an own
// ship and a target tell which second it is.
wire::ExerciseState recorded_exercise(const RecordedScene& scene, int second);

// A file of it in a folder of its own, gone with this object.
class RecordedFile {
 public:
  explicit RecordedFile(const RecordedScene& scene, const recording::WriterOptions& options = {});
  // Whatever `write` puts into it.
  explicit RecordedFile(const std::function<void(recording::RecordingWriter&)>& write,
                        const recording::WriterOptions& options = {});
  ~RecordedFile();
  RecordedFile(const RecordedFile&) = delete;
  RecordedFile& operator=(const RecordedFile&) = delete;

  const std::string& path() const { return path_; }
  // Error: an exception.
  recording::RecordingReader open() const;
  // The file without what lies from `size` on.
  void cut(std::size_t size) const;
  std::size_t size() const;

 private:
  std::string folder_, path_;
};

// One item of any message.
template <typename Message>
void add(recording::RecordingWriter& writer, const recording::Topic& topic, UtcTime time,
         const Message& message) {
  const std::string bytes = message.SerializeAsString();
  writer.add(recording::Item{
      topic, time, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
}

}  // namespace skerry::server
