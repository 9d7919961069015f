#include "server/track_tool/spoke_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<SpokeHeader> headers_of(const SpokeFile& file, const SpokeChoice& choice) {
  std::vector<SpokeHeader> headers;
  const SpokesTaken taken =
      file.each_spoke(choice, [&](const Spoke& spoke) { headers.push_back(spoke.header); });
  EXPECT_EQ(taken.spokes, headers.size());
  return headers;
}

TEST(SpokeFile, GivesTheSpokesOfTheFirstViewInOrder) {
  const RecordedFile recorded({.turns = 3, .radars = {4, 2}, .views = {1, 0}});
  const SpokeFile file(recorded.path());
  EXPECT_TRUE(file.warnings().empty());
  EXPECT_EQ(file.chosen({}).radar, 2u);
  EXPECT_EQ(file.chosen({}).view, 0u);
  const auto headers = headers_of(file, {});
  ASSERT_EQ(headers.size(), 3u * 256u);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    ASSERT_EQ(headers[i].radar, 2u);
    ASSERT_EQ(headers[i].view, 0u);
    ASSERT_EQ(headers[i].sequence, 5'000'000u + i);
  }
}

TEST(SpokeFile, GivesTheRadarViewAndPartAskedFor) {
  // Turns of 2 s.
  const RecordedFile recorded({.turns = 4,
                               .radars = {0, 1},
                               .views = {0, 3},
                               .marks = {{std::chrono::seconds(6), "collision"}}});
  const SpokeFile file(recorded.path());
  const auto headers =
      headers_of(file, {.radar = 1, .view = 3, .from = "0:02", .until = "collision"});
  ASSERT_EQ(headers.size(), 2u * 256u);
  EXPECT_EQ(headers.front().utc, kRecordedAt + std::chrono::seconds(2));
  EXPECT_EQ(headers.back().scan, 1002u);
  for (const SpokeHeader& header : headers) {
    ASSERT_EQ(header.radar, 1u);
    ASSERT_EQ(header.view, 3u);
  }
}

TEST(SpokeFile, TellsItsProgress) {
  const RecordedFile recorded({.turns = 20});
  std::vector<double> shares;
  const SpokeFile file(recorded.path());
  file.each_spoke(
      {}, [](const Spoke&) {}, [&](double share, const char*) { shares.push_back(share); });
  ASSERT_EQ(shares.size(), 5u);  // every 1024 spokes
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LE(shares.back(), 1.0);
}

TEST(SpokeFile, TellsTheBeamOfARadar) {
  const RecordedFile recorded([](recording::RecordingWriter& writer) {
    wire::Hello hello;
    hello.add_radars()->set_radar(3);
    hello.mutable_radars(0)->set_beam_width_deg(0.75);
    add(writer, {recording::Kind::hello}, kRecordedAt, hello);
  });
  const SpokeFile file(recorded.path());
  EXPECT_EQ(file.beam_deg(3), 0.75);
  EXPECT_EQ(file.beam_deg(0), 0.0);
}

TEST(SpokeFile, SaysWhichRadarsThereAre) {
  const RecordedFile recorded({.turns = 1, .radars = {0, 2}, .views = {0, 1}});
  const SpokeFile file(recorded.path());
  EXPECT_THAT(error_of([&] { headers_of(file, {.radar = 9}); }),
              AllOf(HasSubstr(recorded.path()), HasSubstr("no spokes of radar 9;"),
                    HasSubstr("radar 0 view 0, radar 0 view 1, radar 2 view 0, radar 2 view 1")));
  EXPECT_THAT(error_of([&] { headers_of(file, {.radar = 2, .view = 5}); }),
              HasSubstr("no spokes of radar 2 view 5;"));
  EXPECT_THAT(error_of([&] { headers_of(file, {.view = 5}); }), HasSubstr("no spokes of view 5;"));
}

TEST(SpokeFile, SaysWhatIsWrongWithAPart) {
  const RecordedFile recorded({.turns = 2});
  const SpokeFile file(recorded.path());
  EXPECT_THAT(error_of([&] { headers_of(file, {.from = "1:99"}); }), HasSubstr("--from: "));
  EXPECT_THAT(error_of([&] { headers_of(file, {.until = "no such mark"}); }),
              AllOf(HasSubstr("--until: "), HasSubstr("no such mark")));
  EXPECT_THAT(error_of([&] { headers_of(file, {.from = "9:00"}); }), HasSubstr("out of range"));
  EXPECT_THAT(error_of([&] { headers_of(file, {.from = "2", .until = "1"}); }),
              HasSubstr("not behind --from"));
}

TEST(SpokeFile, OfARecordingWithoutSpokesSaysSo) {
  const RecordedFile recorded({.turns = 1, .change = [](Spoke&) { return false; }});
  const SpokeFile file(recorded.path());
  EXPECT_THAT(error_of([&] { headers_of(file, {}); }), HasSubstr("it has no spokes"));
}

TEST(SpokeFile, GivesWhatIsLeftOfACutFile) {
  const RecordedFile recorded({.turns = 40});
  recorded.cut(recorded.size() * 7 / 10);
  const SpokeFile file(recorded.path());
  ASSERT_EQ(file.warnings().size(), 1u);
  EXPECT_THAT(file.warnings()[0], AllOf(HasSubstr(recorded.path()), HasSubstr("byte ")));
  const auto headers = headers_of(file, {});
  EXPECT_GT(headers.size(), 1000u);
  EXPECT_LT(headers.size(), 40u * 256u);
}

TEST(SpokeFile, CutAnywhereIsReadOrRefusedByName) {
  const RecordedFile whole({.turns = 2});
  for (std::size_t size = 0; size < 400; size += 7) {
    const RecordedFile recorded({.turns = 2});
    recorded.cut(size);
    EXPECT_THAT(error_of([&] {
                  const SpokeFile file(recorded.path());
                  headers_of(file, {});
                }),
                HasSubstr(recorded.path()))
        << size;
  }
}

class OtherFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  fs::path folder_ = fs::path(testing::TempDir()) / "track_tool_files";
};

TEST_F(OtherFiles, AreRefusedByName) {
  const auto refused = [](const std::string& path, const std::string& why) {
    EXPECT_THAT(error_of([&] { SpokeFile file(path); }), AllOf(HasSubstr(path), HasSubstr(why)));
  };
  refused((folder_ / "none.mcap").string(), "No such file");
  refused((folder_ / "none.pcap").string(), "No such file");
  refused(folder_.string(), "is a folder");
  refused(put("empty.mcap", ""), "byte 0");
  refused(put("empty.pcap", ""), "Expected a recording");
  refused(put("words.txt", "neither this nor that, but long enough to have a header of a capture"),
          "Expected a recording");
  refused(put("garbage.mcap", std::string(1000, 'x')), "byte 0");
}

// The beginning of a real radar's capture, and nothing left behind.
TEST_F(OtherFiles, CapturesAreImported) {
  const std::string capture =
      SKERRY_SOURCE_DIR "/../shared/data/radar/garminxhd_txon_txoff.pcap.gz";
  if (!fs::exists(capture)) GTEST_SKIP() << "no captures of real radars beside the repository";
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", folder_.c_str(), 1);
  {
    const SpokeFile file(capture);
    EXPECT_TRUE(fs::is_empty(folder_)) << "what was imported stays while it is read";
    const auto headers = headers_of(file, {});
    EXPECT_GT(headers.size(), 500u);
    for (std::size_t i = 1; i < headers.size(); ++i) {
      ASSERT_GE(headers[i].utc, headers[i - 1].utc);
    }
  }
  before ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
}

}  // namespace
}  // namespace skerry::server
