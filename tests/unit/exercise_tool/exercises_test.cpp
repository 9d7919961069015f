// The shipped exercises: each is good, runs to its end and passes its own checks.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/exercise_tool/land_check.hpp"
#include "server/world/shipped_exercises.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

class Exercises : public testing::TestWithParam<const char*> {};

const echo::ChartSource& world_chart() {
  static const auto chart = open_charts({}, "");
  return *chart;
}

TEST_P(Exercises, HasASheetAndNobodyOnLand) {
  const scenario::Scenario scenario = open_scenario(GetParam()).scenario;
  ASSERT_TRUE(scenario.has_exercise());
  const scenario::ExerciseSheet& sheet = scenario.exercise();
  EXPECT_GE(sheet.length_min(), 20.0);
  EXPECT_LE(sheet.length_min(), 40.0);
  EXPECT_FALSE(sheet.briefing().empty());
  EXPECT_GE(sheet.answers_size(), 3);
  EXPECT_GE(sheet.checks_size(), 2);
  EXPECT_GE(scenario.events_size(), 2);
  for (const auto& ship : scenario.own_ships()) EXPECT_TRUE(ship.has_ship_class());
  for (const std::string& complaint :
       land_complaints(scenario, world_chart(), sheet.length_min())) {
    ADD_FAILURE() << complaint;
  }
}

TEST_P(Exercises, RunsToItsEndAndPassesItsChecks) {
  const ExercisePlan plan = exercise_plan(open_scenario(GetParam()).scenario);
  ExerciseRun run(plan, world_chart(), {});
  const bool whole = run.run({{},
                              [](const CheckResult& result, const std::vector<CheckedTurn>&) {
                                for (const auto& line : result.lines) {
                                  std::printf("  %5.1f min %s %s\n", result.check->at_min(),
                                              line.passed ? "pass" : "FAIL", line.text.c_str());
                                  EXPECT_TRUE(line.passed) << line.text;
                                }
                              },
                              {}});
  EXPECT_TRUE(whole);
  EXPECT_EQ(run.not_reached(), 0);
}

// Means of Hansa's rudder on her track, by herself: before the walls, along the southern one, and
// between the two.
struct RiverHelm {
  double before_deg = 0.0, along_deg = 0.0, between_deg = 0.0;
};

RiverHelm river_helm(const scenario::Scenario& scenario) {
  World world(scenario);
  RiverHelm helm;
  for (int tick = 0; tick < 14 * 600; ++tick) {
    world.step();
    const double rudder = world.state().own_ships.front().con->rudder_deg;
    if (tick >= 3600 && tick < 4200) helm.before_deg += rudder / 600;
    if (tick >= 5100 && tick < 5700) helm.along_deg += rudder / 600;
    if (tick >= 6900 && tick < 8400) helm.between_deg += rudder / 1500;
  }
  EXPECT_FALSE(world.state().own_ships.front().aground);
  std::printf("before %.2f deg, along %.2f deg, between %.2f deg\n", helm.before_deg,
              helm.along_deg, helm.between_deg);
  return helm;
}

TEST(RiverExercise, TheSouthernWallWantsHelmTowardsItAndTheGateNone) {
  scenario::Scenario scenario = open_scenario("river").scenario;
  const RiverHelm helm = river_helm(scenario);
  EXPECT_LT(std::fabs(helm.before_deg), 0.2);
  EXPECT_GT(helm.along_deg, 1.5) << "to starboard";
  EXPECT_LT(std::fabs(helm.between_deg), 0.5);
  scenario.clear_banks();
  EXPECT_LT(std::fabs(river_helm(scenario).along_deg), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Exercises,
                         testing::Values("crossing", "fairway", "fog", "night", "rain", "river",
                                         "search", "sensors", "storm", "tss"),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace skerry::server
