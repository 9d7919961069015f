// The commands of `skerry traffic`, as a user has them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "server/app/exercise_files.hpp"
#include "tests/unit/exercise_tool/tool_run.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

ToolRun traffic(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "traffic");
  return run_tool(std::move(arguments), [](CLI::App& app) {
    CLI::App& command = add_traffic_commands(app);
    return std::vector{make_traffic_import_command(command), make_traffic_export_command(command)};
  });
}

class TrafficCommands : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  static std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_ =
      fs::path(testing::TempDir()) / ("traffic_commands_" + std::to_string(getpid()));
};

TEST_F(TrafficCommands, AnExportIsImportedAndIncluded) {
  const ToolRun exported =
      traffic({"export", "crossing", "-o", at("c.nmea"), "--minutes", "3", "--own-ships"});
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(exported.out.find("of 6 ships and marks in 3.0 min"), std::string::npos)
      << exported.out;
  std::ofstream(at("c.nmea"), std::ios::app) << "# a comment\n!AIVDM,broken\n";
  const ToolRun imported = traffic({"import", at("c.nmea"), "-o", at("c.yaml")});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.out.find("6 ships in 6 tracks"), std::string::npos) << imported.out;
  EXPECT_NE(imported.out.find("1  left out: no sentence in the line"), std::string::npos)
      << imported.out;
  EXPECT_NE(imported.out.find("1  left out: cut short"), std::string::npos) << imported.out;
  EXPECT_NE(imported.out.find("minute 0 is 2026-01-01T00:00:00Z"), std::string::npos);
  std::ofstream(at("main.yaml"))
      << "include: [c.yaml]\nname: A\n"
         "own_ships: [{name: B, position: {lat: 56, lon: 4}, radars: [{}]}]\n";
  EXPECT_EQ(open_scenario(at("main.yaml")).scenario.targets_size(), 6);
}

// A recording that a former version made, in which own ship was ordered about.
TEST_F(TrafficCommands, ARecordedExerciseHasItsOwnTimesAndOrders) {
  const std::string recording = SKERRY_SOURCE_DIR "/tests/golden/recordings/inputs.mcap";
  const ToolRun run = traffic(
      {"export", recording, "-o", at("r.csv"), "--every", "1", "--own-ships", "--minutes", "0.2"});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string text = text_of(at("r.csv"));
  EXPECT_NE(text.find("257000111,2026-11-23T09:33:16Z,60.4250000,5.0400000,12.0,335.0,335.0,Tern"),
            std::string::npos)
      << text.substr(0, 300);
  const std::size_t later = text.find("257000111,2026-11-23T09:33:28Z");
  ASSERT_NE(later, std::string::npos);
  EXPECT_EQ(text.substr(later, 80).find(",12.0,335.0,335.0,"), std::string::npos)
      << "she was ordered otherwise: " << text.substr(later, 80);
}

TEST_F(TrafficCommands, ImportTakesOnlyWhatIsWanted) {
  std::ofstream(at("t.csv")) << "mmsi,time,lat,lon\n"
                                "219000001,2021-01-05T00:00:00Z,55.0,11.0\n"
                                "219000001,2021-01-05T00:10:00Z,55.0,11.0\n"
                                "219000001,2021-01-05T00:20:00Z,55.0,11.0\n"
                                "219000002,2021-01-05T00:10:00Z,56.0,11.0\n"
                                "219000002,2021-01-05T00:20:00Z,56.0,11.0\n";
  const ToolRun run =
      traffic({"import", at("t.csv"), "-o", at("t.yaml"), "--from", "2021-01-05T00:05:00Z",
               "--until", "2021-01-05T00:30:00Z", "--area", "55,11,10", "--tolerance", "5"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("1 ships in 1 tracks, 2 fixes"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1  left out: out of the time wanted"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("2  left out: out of the area wanted"), std::string::npos) << run.out;
  EXPECT_NE(text_of(at("t.yaml")).find("start_min: 5,"), std::string::npos) << "--from is minute 0";
}

TEST_F(TrafficCommands, WhatCannotBeDoneIsSaidAndLeavesNoFile) {
  std::ofstream(at("text")) << "nothing\n";
  const ToolRun nothing = traffic({"import", at("text"), "-o", at("x.yaml")});
  EXPECT_EQ(nothing.code, 1);
  EXPECT_NE(nothing.err.find("no ship is left"), std::string::npos) << nothing.err;
  EXPECT_FALSE(fs::exists(at("x.yaml")));
  EXPECT_EQ(traffic({"import", at("none"), "-o", at("x.yaml")}).code, 2);
  EXPECT_EQ(traffic({"import", at("text"), "-o", at("x.yaml"), "--area", "55,11"}).code, 2);
  EXPECT_EQ(traffic({"import", at("text"), "-o", at("x.yaml"), "--from", "noon"}).code, 2);
  EXPECT_EQ(traffic({"import", at("text")}).code, 2);
  EXPECT_EQ(traffic({"import", at("text"), "-o", at("text")}).code, 1) << "it is there already";

  EXPECT_EQ(traffic({"export", "crossing", "-o", at("x.txt")}).code, 1);
  std::ofstream(at("old.nmea")) << "old";
  EXPECT_EQ(traffic({"export", "crossing", "-o", at("old.nmea")}).code, 1);
  EXPECT_EQ(traffic({"export", "no such exercise", "-o", at("old.nmea"), "--force"}).code, 1);
  EXPECT_EQ(traffic({"export", at("old.nmea"), "-o", at("new.csv")}).code, 1);
  EXPECT_EQ(text_of(at("old.nmea")), "old");
  std::ofstream(at("no.mcap")) << "no recording";
  EXPECT_EQ(traffic({"export", at("no.mcap"), "-o", at("new.csv")}).code, 1);
  std::size_t files = 0;
  for (const auto& each : fs::directory_iterator(folder_)) files += each.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 3u) << "text, old.nmea and no.mcap";
}

}  // namespace
}  // namespace skerry::server
