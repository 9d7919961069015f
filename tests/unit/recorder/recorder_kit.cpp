#include "tests/unit/recorder/recorder_kit.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"

namespace skerry::server {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "skerry-recorder-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> ScratchFolder::recordings() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    if (entry.path().extension() == ".mcap") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

RecordedHost::RecordedHost(std::uint32_t radars, std::size_t ring_sectors)
    : FakeHost(radars, ring_sectors) {
  begin_utc = std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
  for (std::uint32_t radar = 0; radar < radars; ++radar) {
    find_channel(radar, 0)->add_format(kNativeFormat, native_encoder());
  }
}

std::string RecordedHost::spoke_bytes(std::uint32_t radar, std::uint64_t sequence) const {
  wire::Spoke message;
  to_message(spoke(radar, sequence), message);
  return message.SerializeAsString();
}

bool comes_true(const std::function<bool()>& done) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!done()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

bool reaches(const RecordingPort& recorder, wire::RecorderState::Phase phase) {
  return comes_true([&] {
    const wire::RecorderState state = recorder.state();
    return state.phase() == phase &&
           (phase != wire::RecorderState::RECORDING || !state.file().empty());
  });
}

wire::Record record_of(wire::Record::Action action, const std::string& name) {
  wire::Record record;
  record.set_action(action);
  record.set_name(name);
  return record;
}

std::vector<std::string> Recorded::of(recording::Kind kind, std::uint32_t radar) const {
  std::vector<std::string> out;
  for (const Item& item : items) {
    if (item.topic.kind == kind && item.topic.radar == radar) out.push_back(item.bytes);
  }
  return out;
}

std::vector<recording::Event> Recorded::events(recording::Event::Kind kind) const {
  std::vector<recording::Event> out;
  for (const std::string& bytes : of(recording::Kind::event)) {
    recording::Event event;
    if (event.ParseFromString(bytes) && event.kind() == kind) out.push_back(event);
  }
  return out;
}

Recorded recorded(const std::string& path) {
  Recorded out;
  const auto reader = recording::RecordingReader::open(path);
  if (!reader.ok()) {
    ADD_FAILURE() << reader.error().to_string();
    return out;
  }
  out.attachments = reader->summary().attachments;
  out.is_whole = !reader->summary().damage.has_value();
  recording::ItemCursor cursor = reader->items();
  while (const auto item = cursor.next()) {
    out.items.push_back(
        {item->topic, item->time, std::string(item->bytes.begin(), item->bytes.end())});
  }
  EXPECT_EQ(cursor.chunks_damaged(), 0u);
  return out;
}

}  // namespace skerry::server
