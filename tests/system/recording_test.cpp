// A real skerryd that records: `skerry record`, its files, its end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "protocol/recording/reader.hpp"
#include "protocol/recording/recording.pb.h"
#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using recording::Kind;
using recording::RecordingReader;
using testing::HasSubstr;

class RunningRecorder : public testing::Test {
 protected:
  std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"--scenario",           scenario_,
                                    "--record-folder",      folder_.path("rec"),
                                    "--record-reserve-mib", "0"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static Ending record(const RunningServer& server, const std::string& what,
                       const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {skerry_program(), "record", what, "--port",
                                    std::to_string(server.tcp_port())};
    all.insert(all.end(), more.begin(), more.end());
    return run(std::move(all));
  }
  // The count of items of a kind, of all radars.
  static std::uint64_t count(const recording::Summary& summary, Kind kind) {
    std::uint64_t items = 0;
    for (const auto& [topic, number] : summary.items) items += topic.kind == kind ? number : 0;
    return items;
  }

  TempFolder folder_;
  std::string scenario_ = folder_.write("small.yaml", small_scenario());
};

TEST_F(RunningRecorder, StartMarkStopFromTheCommandLine) {
  RunningServer server(arguments());
  EXPECT_THAT(record(server, "status").out, HasSubstr("off"));
  Ending ending = record(server, "start", {"watch 3"});
  ASSERT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("recording"));
  EXPECT_THAT(ending.out, HasSubstr(folder_.path("rec/watch 3.mcap")));
  ending = record(server, "start");
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("stop it before"));
  EXPECT_EQ(server.skerry("set", {"--gain", "61"}).code, 0);
  EXPECT_EQ(record(server, "mark", {"collision"}).code, 0);
  EXPECT_THAT(record(server, "status").out, HasSubstr("1"));
  ending = record(server, "stop");
  ASSERT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("off"));
  EXPECT_EQ(record(server, "stop").code, 1);
  EXPECT_EQ(record(server, "start", {"../out"}).code, 1);

  const auto reader = RecordingReader::open(folder_.path("rec/watch 3.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  const recording::Summary& summary = reader->summary();
  EXPECT_FALSE(summary.damage.has_value());
  ASSERT_EQ(summary.marks.size(), 1u);
  EXPECT_EQ(summary.marks[0].name, "collision");
  EXPECT_GT(count(summary, Kind::spoke), 0u);
  EXPECT_GT(count(summary, Kind::traffic), 0u);
  EXPECT_TRUE(reader->hello().has_value());
  bool told = false;
  recording::ItemCursor events = reader->items({{Kind::event}});
  while (const auto item = events.next()) {
    recording::Event event;
    ASSERT_TRUE(event.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())));
    told = told || (event.kind() == recording::Event::CONTROL &&
                    event.text().find("gain") != std::string::npos);
  }
  EXPECT_TRUE(told) << "the change of the gain";
  EXPECT_FALSE(summary.attachments.empty());
}

TEST_F(RunningRecorder, FinishesItsFileWhenTheServerStops) {
  {
    RunningServer server(arguments({"--record", "--record-compression", "zstd"}));
    while (record(server, "status").out.find(".mcap") == std::string::npos) continue;
    EXPECT_EQ(server.skerry("snapshot", {"-o", folder_.path("a.png")}).code, 0);
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("rec"))) {
    if (entry.path().extension() != ".mcap") continue;
    ++files;
    const auto reader = RecordingReader::open(entry.path().string());
    ASSERT_TRUE(reader.ok()) << reader.error().to_string();
    EXPECT_FALSE(reader->summary().damage.has_value());
    EXPECT_EQ(reader->summary().compression, "zstd");
    EXPECT_GT(count(reader->summary(), Kind::spoke), 0u);
  }
  EXPECT_EQ(files, 1);
}

TEST_F(RunningRecorder, AFolderIsOneRecordersAlone) {
  RunningServer first(arguments()), second(arguments());
  ASSERT_EQ(record(first, "start", {"a"}).code, 0);
  Ending ending = record(second, "start", {"b"});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("another recorder"));
  ASSERT_EQ(record(first, "stop").code, 0);
  ending = record(second, "start", {"b"});
  EXPECT_EQ(ending.code, 0) << ending.err;
  EXPECT_EQ(record(second, "start", {"c"}).code, 1);
}

TEST_F(RunningRecorder, StateIsInTheStatusOfTheServer) {
  RunningServer server(arguments());
  ASSERT_EQ(record(server, "start", {"a"}).code, 0);
  EXPECT_THAT(server.skerry("status").out, HasSubstr("RECORDER  recording"));
  const Ending json = server.skerry("status", {"--json"});
  EXPECT_THAT(json.out, HasSubstr("\"phase\": \"RECORDING\""));
  EXPECT_THAT(record(server, "status", {"--json"}).out, HasSubstr("\"file\": \"a.mcap\""));
}

// A playback is recorded as it is shown, and that recording has the same spokes.
TEST_F(RunningRecorder, RecordsAPlayback) {
  {
    RunningServer server(arguments({"--record"}));
    while (record(server, "status").out.find(".mcap") == std::string::npos) continue;
    EXPECT_EQ(server.skerry("snapshot", {"-o", folder_.path("a.png")}).code, 0);
    ASSERT_EQ(record(server, "stop").code, 0);
    ASSERT_EQ(record(server, "start", {"a"}).code, 0);
    EXPECT_EQ(server.skerry("snapshot", {"-o", folder_.path("b.png")}).code, 0);
    ASSERT_EQ(record(server, "stop").code, 0);
  }
  const std::string original = folder_.path("rec/a.mcap");
  {
    RunningServer server({"--play", original, "--play-paused", "--record-folder",
                          folder_.path("again"), "--record-reserve-mib", "0"});
    ASSERT_EQ(record(server, "start", {"b"}).code, 0);
    const Ending ending = run({skerry_program(), "play", "--server", "--port",
                               std::to_string(server.tcp_port()), "play"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    const auto spokes = [&] {
      return RecordingReader::open(original)->summary().items.at({Kind::spoke, 0, 0});
    };
    const std::string json_spokes = "\"spokes\": \"";
    for (std::uint64_t taken = 0; taken < spokes();) {
      const std::string status = record(server, "status", {"--json"}).out;
      const auto at = status.find(json_spokes);
      ASSERT_NE(at, std::string::npos) << status;
      taken = std::stoull(status.substr(at + json_spokes.size()));
    }
    ASSERT_EQ(record(server, "stop").code, 0);
  }
  const auto again = RecordingReader::open(folder_.path("again/b.mcap"));
  ASSERT_TRUE(again.ok()) << again.error().to_string();
  EXPECT_FALSE(again->summary().damage.has_value());
  EXPECT_GT(again->summary().items.at({Kind::spoke, 0, 0}), 0u);
  // Its times are those of what was played, not of today.
  const auto first = RecordingReader::open(original);
  EXPECT_LT(again->summary().end, first->summary().end + std::chrono::seconds(5));
}

// The inputs of an exercise are enough to make its video again.
TEST_F(RunningRecorder, InputsAloneMakeTheVideoAgain) {
  {
    RunningServer server(arguments());
    const Ending started = record(server, "start", {"inputs", "--inputs-only"});
    ASSERT_EQ(started.code, 0) << started.err;
    EXPECT_EQ(server.skerry("set", {"--gain", "63"}).code, 0);
    EXPECT_EQ(server.skerry("snapshot", {"-o", folder_.path("a.png")}).code, 0);
    ASSERT_EQ(record(server, "stop").code, 0);
  }
  const std::string file = folder_.path("rec/inputs.mcap");
  const auto reader = RecordingReader::open(file);
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  EXPECT_EQ(count(reader->summary(), Kind::spoke), 0u);
  EXPECT_LT(reader->summary().file_bytes, 100'000u);
  const Ending verified = run({skerry_program(), "recording", "verify", file});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

}  // namespace
}  // namespace skerry::system_test
