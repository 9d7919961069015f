// Everything written is read again, byte for byte, in the order of time.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"
#include "tests/unit/recording/recording_kit.hpp"

namespace skerry::recording {
namespace {

using kit::Kept;

std::vector<WriterOptions> all_options() {
  std::vector<WriterOptions> all;
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    for (const bool compact : {false, true}) {
      for (const std::size_t chunk_bytes : {std::size_t{64} << 10, std::size_t{2} << 20}) {
        WriterOptions options;
        options.compression = compression;
        options.compact = compact;
        options.chunk_bytes = chunk_bytes;
        all.push_back(options);
      }
    }
  }
  return all;
}

std::vector<Kept> by_time(std::vector<Kept> items) {
  std::stable_sort(items.begin(), items.end(),
                   [](const Kept& a, const Kept& b) { return a.time < b.time; });
  return items;
}

TEST(Recording, ComesBackByteForByteWithEveryOption) {
  const kit::Folder folder;
  const auto items = by_time(kit::exercise(1000));
  for (const WriterOptions& options : all_options()) {
    const std::string path = folder.put("a.mcap", kit::recording_of(items, options));
    const auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.ok()) << reader.error().to_string();
    const Summary& summary = reader->summary();
    EXPECT_EQ(summary.compact, options.compact);
    EXPECT_FALSE(summary.damage) << summary.damage->to_string();

    EXPECT_EQ(summary.begin, items.front().time);
    EXPECT_EQ(summary.end, items.back().time);
    EXPECT_EQ(summary.items.at({Kind::spoke, 1, 0}), 1000U);
    ASSERT_EQ(summary.marks.size(), 3U);
    EXPECT_EQ(summary.marks[1].name, "mark 599");
    EXPECT_EQ(summary.marks[1].time, kit::at(599 * 0.005));
    EXPECT_EQ(reader->hello()->server(), "test");
    EXPECT_EQ(kit::read_all(reader->items()), items);
  }
}

TEST(Recording, OfValuesIsThatOfTheirBytes) {
  const kit::Folder folder;
  for (const bool compact : {false, true}) {
    Bytes file;
    WriterOptions options;
    options.compact = compact;
    RecordingWriter writer(
        [&](std::span<const std::uint8_t> bytes) {
          file.insert(file.end(), bytes.begin(), bytes.end());
          return true;
        },
        options);
    std::vector<Kept> expected;
    for (std::uint32_t number = 0; number < 300; ++number) {
      writer.add(kit::spoke(number));
      expected.push_back(kit::spoke_item(number));
    }
    ASSERT_TRUE(writer.finish());
    EXPECT_EQ(writer.counts().spokes, 300U);
    EXPECT_EQ(kit::read_all(folder.put("a.mcap", file)), expected);
  }
}

TEST(Recording, GivesItemsInTheOrderOfTimeAcrossChunks) {
  const kit::Folder folder;
  auto items = kit::exercise(600);
  // Within 0.3 s as it pleases: chunks then overlap.
  std::mt19937 random(7);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double jitter = std::uniform_real_distribution(0.0, 0.3)(random);
    order.emplace_back(in_seconds(items[i].time.time_since_epoch()) + jitter, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Kept> shuffled;
  for (const auto& [key, i] : order) shuffled.push_back(items[i]);
  for (const WriterOptions& options : all_options()) {
    const auto read = kit::read_all(folder.put("a.mcap", kit::recording_of(shuffled, options)));
    ASSERT_EQ(read.size(), items.size());
    EXPECT_TRUE(std::is_sorted(read.begin(), read.end(),
                               [](const Kept& a, const Kept& b) { return a.time < b.time; }));
    const auto less = [](const Kept& a, const Kept& b) {
      return std::tie(a.time, a.topic, a.bytes) < std::tie(b.time, b.topic, b.bytes);
    };
    auto as_set = read;
    auto expected = items;
    std::sort(as_set.begin(), as_set.end(), less);
    std::sort(expected.begin(), expected.end(), less);
    EXPECT_EQ(as_set, expected);
  }
}

TEST(Recording, SeeksToAnyTime) {
  const kit::Folder folder;
  const auto items = by_time(kit::exercise(1500));
  for (const WriterOptions& options : all_options()) {
    const auto reader =
        RecordingReader::open(folder.put("a.mcap", kit::recording_of(items, options)));
    ASSERT_TRUE(reader.ok());
    ItemCursor cursor = reader->items();
    for (const double seconds : {5.0, 0.0, 7.4999, 3.14159, -1.0, 100.0, 2.5}) {
      cursor.seek(kit::at(seconds));
      const auto first = std::find_if(items.begin(), items.end(), [&](const Kept& item) {
        return item.time >= kit::at(seconds);
      });
      const auto item = cursor.next();
      ASSERT_EQ(item.has_value(), first != items.end()) << seconds;
      if (!item) continue;
      EXPECT_EQ(item->time, first->time) << seconds;
      EXPECT_EQ(std::string(item->bytes.begin(), item->bytes.end()), first->bytes);
    }
  }
}

TEST(Recording, GivesOfOneTopicWhatWasInForce) {
  const kit::Folder folder;
  const auto items = by_time(kit::exercise(1500));
  for (const WriterOptions& options : all_options()) {
    const auto reader =
        RecordingReader::open(folder.put("a.mcap", kit::recording_of(items, options)));
    ASSERT_TRUE(reader.ok());
    for (const Topic& topic :
         {Topic{Kind::settings}, Topic{Kind::own_ship, 1}, Topic{Kind::spoke, 1, 0}}) {
      for (const double seconds : {-0.001, 0.0, 0.9999, 1.0, 4.2, 100.0}) {
        std::optional<std::string> expected;
        for (const Kept& item : items) {
          if (item.topic == topic && item.time <= kit::at(seconds)) expected = item.bytes;
        }
        const auto last = reader->last_before(topic, kit::at(seconds));
        ASSERT_EQ(last.has_value(), expected.has_value()) << seconds;
        if (!last) continue;
        EXPECT_EQ(std::string(last->bytes.begin(), last->bytes.end()), *expected);
      }
    }
    EXPECT_FALSE(reader->last_before({Kind::settings, 3}, kit::at(100)));
    const auto marks = kit::read_all(reader->items({{Kind::event}}));
    EXPECT_EQ(marks.size(), 5U);
  }
}

TEST(Recording, KeepsAttachments) {
  const kit::Folder folder;
  Bytes file;
  RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
        return true;
      },
      {});
  writer.add(kit::hello_item().item());
  writer.attach({"scenario.yaml", "application/yaml", kit::at(1), "name: test\n"});
  writer.add(kit::spoke_item(3).item());
  ASSERT_TRUE(writer.finish());
  const auto reader = RecordingReader::open(folder.put("a.mcap", file));
  ASSERT_TRUE(reader.ok());
  ASSERT_EQ(reader->summary().attachments.size(), 1U);
  const Attachment& attachment = reader->summary().attachments.front();
  EXPECT_EQ(attachment.name, "scenario.yaml");
  EXPECT_EQ(attachment.media_type, "application/yaml");
  EXPECT_EQ(attachment.time, kit::at(1));
  EXPECT_EQ(attachment.bytes, "name: test\n");
  EXPECT_EQ(kit::read_all(reader->items()).size(), 2U);
}

TEST(Recording, OfNothingIsARecording) {
  const kit::Folder folder;
  const auto reader = RecordingReader::open(folder.put("a.mcap", kit::recording_of({})));
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  EXPECT_FALSE(reader->summary().damage);
  EXPECT_EQ(reader->summary().begin, reader->summary().end);
  EXPECT_FALSE(reader->hello());
  EXPECT_TRUE(kit::read_all(reader->items()).empty());
}

// A full disk: what the sink does not take is counted, the rest is whole.
TEST(Recording, GoesOnAfterTheSinkHadNoRoom) {
  const kit::Folder folder;
  Bytes file;
  bool room = false;
  WriterOptions options;
  options.chunk_bytes = 64 << 10;
  RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        if (room) file.insert(file.end(), bytes.begin(), bytes.end());
        return room;
      },
      options);
  std::vector<Kept> expected;
  std::uint64_t dropped = 0;
  for (std::uint32_t number = 0; number < 1000; ++number) {
    room = number / 250 % 2 == 1;
    if (number % 250 == 0) {
      const bool taken = writer.flush();
      EXPECT_TRUE(taken || !room || number == 250 || number == 750);
    }
    writer.add(kit::spoke_item(number).item());
    dropped = writer.counts().spokes_dropped;
  }
  room = true;
  ASSERT_TRUE(writer.finish());
  EXPECT_GT(dropped, 0U);
  const auto read = kit::read_all(folder.put("a.mcap", file));
  EXPECT_EQ(read.size() + writer.counts().spokes_dropped, 1000U);
  EXPECT_EQ(writer.counts().items_dropped, writer.counts().spokes_dropped);
  for (const Kept& item : read) {
    wire::Spoke message;
    ASSERT_TRUE(message.ParseFromString(item.bytes));
    EXPECT_EQ(item, kit::spoke_item(static_cast<std::uint32_t>(message.sequence())));
  }
}

}  // namespace
}  // namespace skerry::recording
