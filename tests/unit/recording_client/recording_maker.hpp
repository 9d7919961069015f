// Recordings made for tests: spokes that tell where they come from.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include "clients/recording/recording_output.hpp"
#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/recording/writer.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::client {

inline constexpr UtcTime kBegin{std::chrono::seconds(1'714'564'800)};

inline std::string test_path(const std::string& name) {
  return testing::TempDir() + "skerry_recording_client_" + std::to_string(::getpid()) + "_" + name;
}

// A recording of ten turns of 128 spokes, 10 ms each, from `begin` on: 12.8 s.
class RecordingMaker {
 public:
  RecordingMaker(std::string path, UtcTime begin)
      : output_(std::move(path), true), writer_(output_.sink(), {}), begin_(begin) {}

  void add(recording::Topic topic, Duration since_begin,
           const google::protobuf::MessageLite& message) {
    const std::string bytes = message.SerializeAsString();
    writer_.add({topic,
                 begin_ + since_begin,
                 {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  }
  void add_hello(const std::vector<std::pair<std::uint32_t, std::string>>& radars) {
    wire::Hello hello;
    hello.set_server("test");
    for (const auto& [number, name] : radars) {
      auto& info = *hello.add_radars();
      info.set_radar(number);
      info.set_name(name);
      info.set_spokes_per_turn(128);
      info.set_cells(256);
      info.set_bits(8);
    }
    add({recording::Kind::hello, 0, 0}, {}, hello);
  }
  void add_mark(Duration since_begin, const std::string& name) {
    recording::Event event;
    event.set_kind(recording::Event::MARK);
    event.set_text(name);
    add({recording::Kind::event, 0, 0}, since_begin, event);
  }
  void add_gain(Duration since_begin, std::uint32_t radar, double gain) {
    wire::Settings settings;
    settings.set_radar(radar);
    settings.set_gain(gain);
    add({recording::Kind::settings, radar, 0}, since_begin, settings);
  }
  // Input `number` of an exercise that began at `began`; 0 is that it began.
  void add_input(Duration since_begin, std::uint64_t began, std::uint64_t number) {
    recording::Input input;
    if (number == 0) {
      input.mutable_began()->set_utc_ns(began);
    } else {
      input.mutable_order()->set_tick(number);
    }
    add({recording::Kind::input, 0, 0}, since_begin, input);
  }
  void add_spokes(std::uint32_t radar, std::uint32_t count = 1280) {
    for (std::uint32_t i = 0; i < count; ++i) {
      Spoke spoke;
      spoke.header.radar = radar;
      spoke.header.sequence = i;
      spoke.header.geometry = {128, 256, 8};
      spoke.header.scan = i / 128;
      spoke.header.index = i % 128;
      spoke.header.range_scale = *RangeScale::find(6.0);
      spoke.header.utc = begin_ + std::chrono::milliseconds(10) * i;
      spoke.cells.assign(256, static_cast<std::uint8_t>(i + radar));
      writer_.add(spoke);
    }
  }
  recording::RecordingWriter& writer() { return writer_; }
  void finish() {
    ASSERT_TRUE(writer_.finish());
    output_.commit();
  }

 private:
  RecordingOutput output_;
  recording::RecordingWriter writer_;
  UtcTime begin_;
};

// All items of a kind, with their times.
struct TimedBytes {
  recording::Topic topic;
  UtcTime time;
  std::vector<std::uint8_t> bytes;
  friend bool operator==(const TimedBytes&, const TimedBytes&) = default;
};
inline std::vector<TimedBytes> items_of(const recording::RecordingReader& reader,
                                        recording::Kind kind) {
  std::vector<TimedBytes> items;
  recording::ItemCursor cursor = reader.items();
  while (const auto item = cursor.next()) {
    if (item->topic.kind != kind) continue;
    items.push_back({item->topic, item->time, {item->bytes.begin(), item->bytes.end()}});
  }
  return items;
}

inline recording::RecordingReader opened(const std::string& path) {
  auto reader = recording::RecordingReader::open(path);
  if (!reader) throw std::runtime_error(reader.error().to_string());
  return std::move(*reader);
}

template <typename Message>
Message parsed(const TimedBytes& item) {
  Message message;
  EXPECT_TRUE(message.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size())));
  return message;
}

}  // namespace skerry::client
