// Recordings that version 0.1 made, one of each kind: what today's code reads in them is what that
// version said of them.  tests/golden/recordings/README.md tells how they were made.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/recording/recording_info.hpp"
#include "protocol/digest/digest.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/topics.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::client {
namespace {

using Json = nlohmann::json;
using recording::RecordingReader;

const std::filesystem::path kFolder = SKERRY_SOURCE_DIR "/tests/golden/recordings";

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".mcap") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// For each topic the SHA-256 of its items in order: time and size as 8 octets each, then the bytes.
std::map<std::string, std::string> sums_of(const RecordingReader& reader) {
  std::map<std::string, Sha256> digests;
  recording::ItemCursor cursor = reader.items();
  while (const auto item = cursor.next()) {
    Bytes head;
    append_little_endian(head, static_cast<std::uint64_t>(item->time.time_since_epoch().count()),
                         8);
    append_little_endian(head, item->bytes.size(), 8);
    Sha256& digest = digests[name_of(recording::ChannelKind{item->topic})];
    digest.add(head);
    digest.add(item->bytes);
  }
  std::map<std::string, std::string> sums;
  for (auto& [topic, digest] : digests) sums[topic] = hexadecimal(digest.take());
  return sums;
}

class FormerRecording : public testing::TestWithParam<std::string> {
 protected:
  Json twin() const {
    std::ifstream file(kFolder / (GetParam() + ".json"));
    return Json::parse(file);
  }
  RecordingReader open() const {
    auto reader = RecordingReader::open((kFolder / (GetParam() + ".mcap")).string());
    if (!reader) throw std::runtime_error(reader.error().to_string());
    return std::move(reader).value();
  }
};

TEST_P(FormerRecording, HasTheItemsItHad) {
  const RecordingReader reader = open();
  EXPECT_EQ(Json(sums_of(reader)), twin().at("sums"));
}

TEST_P(FormerRecording, InfoSaysWhatItSaid) {
  const RecordingReader reader = open();
  const auto check = check_recording(reader);
  ASSERT_TRUE(check.ok()) << check.error().to_string();
  Json now = Json::parse(info_json(reader, *check));
  now["file"] = GetParam() + ".mcap";
  EXPECT_EQ(now, twin().at("info"));
}

INSTANTIATE_TEST_SUITE_P(Of, FormerRecording, testing::ValuesIn(names()),
                         [](const auto& of) { return of.param; });

// A kind whose file went missing would not be tested.
TEST(FormerRecordings, AreOneOfEachKind) {
  const std::vector<std::string> kinds = {
      "all_views",       "audit",      "compact_lz4", "compact_none", "compact_zstd", "cut",
      "imported_cat240", "inputs",     "inputs_nmea", "joined",       "lz4",          "none",
      "playback",        "unfinished", "zstd"};
  EXPECT_EQ(names(), kinds);
}

}  // namespace
}  // namespace skerry::client
