// The commands of `skerry scenario`, one after the other as a user has them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/exercise_tool/new_scenario.hpp"
#include "tests/unit/exercise_tool/tool_run.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

ToolRun ran(std::vector<std::string> arguments) {
  return run_tool(std::move(arguments), [](CLI::App& app) {
    return std::vector{make_new_command(app), make_check_command(app), make_list_command(app),
                       make_run_command(app)};
  });
}

class ScenarioCommands : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::path(testing::TempDir()) / "scenario_commands";
  std::string file_ = (folder_ / "mine.yaml").string();
};

TEST_F(ScenarioCommands, ANewScenarioIsGoodAndRuns) {
  for (const std::string& scheme : scenario_templates()) {
    const ToolRun made =
        ran({"new", file_, "--template", scheme, "--force", "--name", "It's \"mine\""});
    EXPECT_EQ(made.code, 0) << made.err;
    const ToolRun checked = ran({"check", file_});
    EXPECT_EQ(checked.code, 0) << scheme << "\n" << checked.err;
    EXPECT_NE(checked.out.find("It's \"mine\": 1 own ships with 1 radars"), std::string::npos)
        << checked.out;
    const ToolRun run = ran({"run", file_, "--fast", "--checks"});
    EXPECT_EQ(run.code, 0) << scheme << "\n" << run.out << run.err;
    EXPECT_NE(run.out.find("times real time"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("closest"), std::string::npos) << run.out;
  }
}

TEST_F(ScenarioCommands, NewDoesNotWriteOverAFileNorOnLand) {
  std::ofstream(file_) << "mine";
  EXPECT_EQ(ran({"new", file_}).code, 1);
  EXPECT_EQ(fs::file_size(file_), 4u);
  const ToolRun ashore = ran({"new", (folder_ / "b.yaml").string(), "--lat", "51", "--lon", "10"});
  EXPECT_EQ(ashore.code, 1);
  EXPECT_NE(ashore.err.find("begins on land"), std::string::npos) << ashore.err;
  EXPECT_EQ(ran({"new", file_, "--template", "none"}).code, 2);
}

TEST_F(ScenarioCommands, CheckSaysAllThatIsWrongAndForceForgivesLand) {
  std::ofstream(file_) << "name: A\nown_ships:\n"
                          "  - {name: B, position: {lat: 51, lon: 10}, radars: [{}]}\n";
  const ToolRun ashore = ran({"check", file_});
  EXPECT_EQ(ashore.code, 1);
  EXPECT_NE(ashore.err.find("own_ships[0] (B): begins on land at 51.0000, 10.0000"),
            std::string::npos)
      << ashore.err;
  EXPECT_EQ(ran({"check", "--force", file_}).code, 0);
  std::ofstream(file_) << "name: A\nseed: x\n";
  const ToolRun wrong = ran({"check", file_, "crossing"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_NE(wrong.err.find("2 errors"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.out.find("crossing: good"), std::string::npos) << "the others are looked at";
  EXPECT_EQ(ran({"check"}).code, 2);
}

TEST_F(ScenarioCommands, ListHasTheShippedAndThoseOfAFolder) {
  std::ofstream(file_) << "name: Mine\nown_ships:\n"
                          "  - {name: B, position: {lat: 57, lon: 3}, radars: [{}]}\n";
  const ToolRun listed = ran({"list", folder_.string()});
  EXPECT_EQ(listed.code, 0);
  for (const char* name : {"crossing", "fairway", "fog", "night", "rain", "river", "search",
                           "sensors", "storm", "tss", "Mine"}) {
    EXPECT_NE(listed.out.find(name), std::string::npos) << name;
  }
}

TEST_F(ScenarioCommands, RunFailsWhereACheckDoesAndDrawsPictures) {
  std::ofstream(file_)
      << "name: A\nown_ships:\n"
         "  - {name: B, position: {lat: 57, lon: 3}, radars: [{}]}\n"
         "targets: [{name: C, position: {lat: 57.02, lon: 3}}]\n"
         "exercise: {goal: g, length_min: 1, checks: [{at_min: 0.5, misses: [C]}]}\n";
  const std::string pictures = (folder_ / "pictures").string();
  const ToolRun run = ran({"run", file_, "--fast", "--pictures", pictures});
  EXPECT_EQ(run.code, 1) << run.out << run.err;
  EXPECT_NE(run.out.find("FAIL misses C"), std::string::npos) << run.out;
  EXPECT_GT(fs::file_size(fs::path(pictures) / "01-0.5min.png"), 10'000u);
  EXPECT_EQ(ran({"run", file_, "--fast", "--until", "0.2"}).code, 0);
}

}  // namespace
}  // namespace skerry::server
