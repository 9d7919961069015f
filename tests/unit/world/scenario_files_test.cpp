// Scenarios of several files, and shipped ones by name.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "server/config/yaml_include.hpp"
#include "server/world/scenario.hpp"
#include "server/world/shipped_exercises.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

class ScenarioFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_ / "parts");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  // What is refused, with "FOLDER/" left out.
  std::string refused(const std::string& path) const {
    std::string what;
    try {
      load_scenario(path);
    } catch (const ConfigError& error) {
      what = error.what();
    }
    const std::string folder = folder_.string() + "/";
    for (std::size_t at; (at = what.find(folder)) != std::string::npos;) {
      what.erase(at, folder.size());
    }
    return what;
  }

  fs::path folder_;
};

const std::string kOneShip =
    "own_ships:\n  - {name: A, position: {lat: 50, lon: 1}, radars: [{}]}\n";

TEST_F(ScenarioFiles, ListsAreAppendedAndTheIncludingFileWins) {
  write("parts/sea.yaml",
        "sea: {state: 5, wind_from_deg: 10}\nseed: 4\n"
        "targets:\n  - {name: One, position: {lat: 50, lon: 2}}\n");
  write("parts/more.yaml",
        "include: [sea.yaml]\nseed: 5\ntargets:\n  - {name: Two, position: {lat: 51, lon: 2}}\n");
  const std::string path =
      write("main.yaml",
            "include: [parts/more.yaml]\nname: Main\n" + kOneShip +
                "sea: {state: 2}\ntargets:\n  - {name: Three, position: {lat: 52, lon: 2}}\n");
  const scenario::Scenario scenario = load_scenario(path);
  EXPECT_EQ(scenario.sea().state(), 2.0);
  EXPECT_EQ(scenario.sea().wind_from_deg(), 10.0);
  EXPECT_EQ(scenario.seed(), 5u);
  ASSERT_EQ(scenario.targets_size(), 3);
  EXPECT_EQ(scenario.targets(0).name(), "One");
  EXPECT_EQ(scenario.targets(1).name(), "Two");
  EXPECT_EQ(scenario.targets(2).name(), "Three");
  EXPECT_EQ(scenario.include_size(), 0);
}

TEST_F(ScenarioFiles, TheWholeIsOneTextThatNeedsNoFiles) {
  write("parts/targets.yaml",
        "targets:\n  - {name: \"07: \\\"odd\\\" # name\", position: {lat: 50.25, lon: -2}}\n"
        "events:\n  - {name: e, at_min: 1, text: 'a\nb'}\n");
  const std::string path =
      write("main.yaml", "include: [parts/targets.yaml]\nname: \"12\"\n" + kOneShip);
  YamlSource source(path);
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::string whole = yaml_text(parse_yaml_whole(text, source));
  EXPECT_EQ(parse_scenario(whole, "whole").SerializeAsString(),
            load_scenario(path).SerializeAsString());
}

TEST_F(ScenarioFiles, ErrorsNameTheFileTheyAreIn) {
  write("parts/targets.yaml", "targets:\n  - {name: T, position: {lat: 99, lon: 2}}\n");
  const std::string path =
      write("main.yaml", "include: [parts/targets.yaml]\nname: M\nseed: x\n" + kOneShip);
  EXPECT_EQ(refused(path),
            "main.yaml:3:7: seed: expected a whole number, given x; allowed: 0 to "
            "18446744073709551615\n"
            "parts/targets.yaml:2:31: targets[0].position.lat: 99 is out of range; allowed: -90 to "
            "90 deg\nmain.yaml: 2 errors");
  write("parts/targets.yaml", "targets: [\n");
  EXPECT_EQ(refused(path).find("parts/targets.yaml:"), 0u) << refused(path);
  write("parts/targets.yaml", kOneShip);
  EXPECT_NE(
      refused(path).find("\"A\" is the name of own_ships[0] too (parts/targets.yaml, line 2)"),
      std::string::npos)
      << refused(path);
}

TEST_F(ScenarioFiles, CyclesAndRepeatsAndMissingFilesAreRefused) {
  write("a.yaml", "include: [b.yaml]\nname: A\n" + kOneShip);
  write("b.yaml", "include: [a.yaml]\n");
  EXPECT_EQ(refused((folder_ / "a.yaml").string()), "b.yaml:1:11: include: a.yaml includes itself");
  write("b.yaml", "seed: 1\n");
  const std::string twice = write("c.yaml", "include: [b.yaml, b.yaml]\nname: A\n" + kOneShip);
  EXPECT_EQ(refused(twice), "c.yaml:1:19: include: b.yaml is included already");
  const std::string none = write("d.yaml", "include: [none.yaml]\nname: A\n" + kOneShip);
  EXPECT_EQ(refused(none),
            "d.yaml:1:11: include: none.yaml: cannot be read: No such file or directory");
  const std::string text = write("e.yaml", "include: b.yaml\nname: A\n" + kOneShip);
  EXPECT_EQ(refused(text), "e.yaml:1:10: include: expected a list of files, given b.yaml");
}

TEST_F(ScenarioFiles, DepthIsBounded) {
  for (int i = 0; i <= kMaxIncludeDepth + 1; ++i) {
    write("n" + std::to_string(i) + ".yaml", "include: [n" + std::to_string(i + 1) + ".yaml]\n");
  }
  const std::string path = write("main.yaml", "include: [n0.yaml]\nname: A\n" + kOneShip);
  EXPECT_NE(refused(path).find("files include each other more than 8 deep"), std::string::npos)
      << refused(path);
}

TEST_F(ScenarioFiles, ATextAloneIncludesNothing) {
  EXPECT_EQ(refusal("include: [/etc/passwd]\nname: A\n" + kOneShip),
            "1:10: include: this text is no file of a folder; allowed: in a scenario's file");
}

TEST(ShippedExercises, AreFoundByNameUnlessThereIsSuchAFile) {
  EXPECT_TRUE(fs::is_regular_file(find_scenario("crossing"))) << find_scenario("crossing");
  EXPECT_EQ(find_scenario("no such exercise"), "no such exercise");
  EXPECT_EQ(find_scenario("./crossing"), "./crossing");
  EXPECT_EQ(scenario_files(exercises_folder()).size(), 10u);
}

}  // namespace
}  // namespace skerry::server
