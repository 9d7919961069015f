#include "tests/unit/recording/recording_kit.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "protocol/recording/recording.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::recording::kit {
namespace {

constexpr std::int64_t kBegin = 1'790'000'000'000'000'000;

template <typename Message>
Kept kept(const Topic& topic, UtcTime time, const Message& message) {
  return {topic, time, message.SerializeAsString()};
}

std::uint32_t scrambled(std::uint32_t n) {
  n = (n ^ n >> 16) * 0x7FEB352DU;
  n = (n ^ n >> 15) * 0x846CA68BU;
  return n ^ n >> 16;
}

}  // namespace

UtcTime at(double seconds) { return UtcTime(Duration(kBegin)) + seconds_as_duration(seconds); }

Spoke spoke(std::uint32_t number, std::uint32_t radar, std::uint32_t view, std::uint32_t cells,
            std::uint32_t bits) {
  Spoke made;
  SpokeHeader& header = made.header;
  header.radar = radar;
  header.view = view;
  header.sequence = number;
  header.geometry = {512, cells, bits};
  header.scan = number / 512;
  header.index = number % 512;
  header.range_scale = *RangeScale::from_index(5);
  header.heading = TrueBearing::from_units(1'000'000U + number * 17);
  header.own_ship = {60.0 + number * 1e-7, 5.0 - number * 3e-7};
  header.utc = at(number * 0.005 + radar * 1e-4 + view * 1e-5);
  header.scenario_time = ScenarioTime(Duration(std::int64_t{number} * 5'000'000));
  const std::uint32_t coast = cells / 3 + number % 512 / 8;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t noise = scrambled(number * 4096 + cell + radar);
    const bool land = cell > coast && cell < coast + 40;
    made.cells.push_back(static_cast<std::uint8_t>((land              ? 150 + noise % 16
                                                    : noise % 29 == 0 ? noise % 64
                                                                      : 0) &
                                                   (bits == 4 ? 15 : 255)));
  }
  return made;
}

Kept spoke_item(std::uint32_t number, std::uint32_t radar, std::uint32_t view,
                std::uint32_t cells) {
  const Spoke made = spoke(number, radar, view, cells);
  wire::Spoke message;
  to_message(made, message);
  return kept({Kind::spoke, radar, view}, made.header.utc, message);
}

Kept hello_item() {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server("test");
  hello.add_radars()->set_name("radar 0");
  return kept({Kind::hello}, at(0), hello);
}

Kept event_item(double seconds, const std::string& mark) {
  Event event;
  event.set_kind(Event::MARK);
  event.set_text(mark);
  return kept({Kind::event}, at(seconds), event);
}

std::vector<Kept> exercise(std::uint32_t spokes) {
  std::vector<Kept> items{hello_item()};
  for (std::uint32_t number = 0; number < spokes; ++number) {
    const double seconds = number * 0.005;
    if (number % 200 == 0) {
      wire::Settings settings;
      settings.set_gain(number);
      wire::OwnShip ship;
      ship.set_heading_deg(number / 10.0);
      wire::World world;
      world.set_scenario_s(seconds);
      Traffic traffic;
      traffic.add_items()->set_number(number);
      Log log;
      log.set_text("line " + std::to_string(number));
      items.push_back(kept({Kind::settings, 0, 0}, at(seconds), settings));
      items.push_back(kept({Kind::own_ship, 1}, at(seconds), ship));
      items.push_back(kept({Kind::world}, at(seconds), world));
      items.push_back(kept({Kind::traffic}, at(seconds), traffic));
      items.push_back(kept({Kind::log}, at(seconds), log));
    }
    if (number % 300 == 299) items.push_back(event_item(seconds, "mark " + std::to_string(number)));
    items.push_back(spoke_item(number, 0));
    items.push_back(spoke_item(number, 1));
  }
  return items;
}

Bytes recording_of(const std::vector<Kept>& items, const WriterOptions& options, bool finish) {
  Bytes file;
  RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
        return true;
      },
      options);
  for (const Kept& item : items) writer.add(item.item());
  EXPECT_TRUE(finish ? writer.finish() : writer.flush());
  EXPECT_EQ(writer.counts().bytes, file.size());
  return file;
}

Folder::Folder() {
  static int made = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("skerry-recording-" + std::to_string(getpid()) + "-" + std::to_string(made++));
  std::filesystem::create_directory(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string Folder::put(const std::string& name, const Bytes& bytes) const {
  std::ofstream file(path(name), std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(file.good());
  return path(name);
}

std::vector<Kept> read_all(ItemCursor cursor) {
  std::vector<Kept> items;
  while (const auto item = cursor.next()) {
    items.push_back({item->topic, item->time, {item->bytes.begin(), item->bytes.end()}});
  }
  return items;
}

std::vector<Kept> read_all(const std::string& path) {
  const auto reader = RecordingReader::open(path);
  EXPECT_TRUE(reader.ok()) << (reader.ok() ? "" : reader.error().to_string());
  if (!reader) return {};
  return read_all(reader->items());
}

}  // namespace skerry::recording::kit
