// Imports in memory, for tests: what was written, read back.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "protocol/captures/importer.hpp"
#include "protocol/pcap/pcap_writer.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::captures {

// When captures made for a test begin, and who sends them.
inline constexpr UtcTime kBegin{std::chrono::seconds(1'714'564'800)};
inline constexpr Ipv4Endpoint kFrom{ipv4(192, 0, 2, 1), 1024};

// A file of its own that goes with the test.
class TestFile {
 public:
  explicit TestFile(const std::string& ending) {
    std::string pattern = testing::TempDir() + "skerry_captures_XXXXXX" + ending;
    const int file = ::mkstemps(pattern.data(), static_cast<int>(ending.size()));
    if (file >= 0) ::close(file);
    path_ = pattern;
  }
  ~TestFile() { ::unlink(path_.c_str()); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;

  const std::string& path() const { return path_; }
  void write(std::span<const std::uint8_t> bytes) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::string path_;
};

// A recording that an import wrote, and what it holds.
struct Imported {
  ImportReport report;
  std::map<std::uint32_t, std::vector<Spoke>> spokes;  // by radar
  std::vector<recording::Event> events;
  std::vector<wire::Settings> settings;
  std::vector<wire::OwnShip> own_ships;
  wire::Hello hello;
  recording::Summary summary;
};

inline void read_items(const recording::RecordingReader& reader, Imported& into) {
  using recording::Kind;
  recording::ItemCursor cursor = reader.items();
  while (const auto item = cursor.next()) {
    const auto parse = [&](auto& message) {
      return message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()));
    };
    if (item->topic.kind == Kind::spoke) {
      wire::Spoke message;
      ASSERT_TRUE(parse(message));
      auto spoke = from_message(message);
      ASSERT_TRUE(spoke.ok()) << spoke.error().text;
      into.spokes[item->topic.radar].push_back(*std::move(spoke));
    } else if (item->topic.kind == Kind::event) {
      ASSERT_TRUE(parse(into.events.emplace_back()));
    } else if (item->topic.kind == Kind::settings) {
      ASSERT_TRUE(parse(into.settings.emplace_back()));
    } else if (item->topic.kind == Kind::own_ship) {
      ASSERT_TRUE(parse(into.own_ships.emplace_back()));
    }
  }
  EXPECT_EQ(cursor.chunks_damaged(), 0u);
}

inline void open_items(const std::string& path, Imported& into) {
  const auto reader = recording::RecordingReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  into.summary = reader->summary();
  EXPECT_FALSE(into.summary.damage.has_value());
  into.hello = reader->hello().value_or(wire::Hello{});
  read_items(*reader, into);
}

// Writes a recording file of the capture, and reads it again.
inline void import_into(const std::string& path, std::span<const std::uint8_t> capture,
                        Imported& into) {
  std::ofstream file(path, std::ios::binary);
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return file.good();
      },
      {});
  auto report =
      import_capture([&](const DatagramSink& sink,
                         const ImportProgress&) { return pcap::read_capture(capture, sink); },
                     "test.pcap", writer);
  ASSERT_TRUE(report.ok()) << report.error().to_string();
  into.report = *std::move(report);
  ASSERT_TRUE(writer.finish());
  file.close();
  open_items(path, into);
}

inline Imported imported(std::span<const std::uint8_t> capture) {
  const TestFile file(".mcap");
  Imported into;
  import_into(file.path(), capture, into);
  return into;
}

}  // namespace skerry::captures
