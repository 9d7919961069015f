// A check of a picture can pass and fail.
#include <gtest/gtest.h>

#include <string>

#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/closest_approach.hpp"
#include "server/exercise_tool/land_check.hpp"
#include "server/exercise_tool/sheet_judge.hpp"

namespace skerry::server {
namespace {

// Off Bergen, with an island between the own ship and one of two equal ships.
const std::string kScenario =
    "name: Judge\n"
    "seed: 3\n"
    "own_ships:\n"
    "  - {name: Own, position: {lat: 60.4700, lon: 5.0100}, course_deg: 0,\n"
    "     radars: [{name: X, range_nm: 12, spokes: 2048, cells: 512}]}\n"
    "targets:\n"
    "  - {name: Near, position: {lat: 60.4900, lon: 4.9960}, length_m: 30, beam_m: 8, height_m: "
    "4}\n"
    "  - {name: Hidden, position: {lat: 60.4174, lon: 5.2590}, length_m: 30, beam_m: 8, height_m: "
    "4}\n"
    "  - {name: Far, position: {lat: 61.4, lon: 4}, length_m: 300, beam_m: 40}\n"
    "racons: [{name: Racon, position: {lat: 60.4840, lon: 5.0190}, code: K, height_m: 4}]\n"
    "events: [{name: gone, at_min: 1, targets: [{target_name: Near, removed: true}]}]\n";

class SheetJudge : public testing::Test {
 protected:
  static const echo::ChartSource& chart() {
    static const auto chart = open_charts({}, "");
    return *chart;
  }

  CheckResult judged(const scenario::ExerciseCheck& check) const {
    CheckResult result = judge(check, plan_, chart(), world_, nullptr);
    for (const auto& line : result.lines) std::printf("  %s\n", line.text.c_str());
    return result;
  }
  bool sees(const std::string& name) const {
    scenario::ExerciseCheck check;
    check.add_sees(name);
    return judged(check).passed();
  }
  bool misses(const std::string& name) const {
    scenario::ExerciseCheck check;
    check.add_misses(name);
    return judged(check).passed();
  }

  ExercisePlan plan_ = exercise_plan(kScenario, "judge.yaml");
  World world_{plan_.scenario};
};

TEST_F(SheetJudge, AShipInSightIsSeenAndOneBehindLandIsNot) {
  EXPECT_TRUE(sees("Near"));
  EXPECT_FALSE(misses("Near"));
  EXPECT_FALSE(sees("Hidden"));
  EXPECT_TRUE(misses("Hidden"));
  EXPECT_FALSE(sees("Far"));
}

TEST_F(SheetJudge, ARemovedShipIsNoLongerSeen) {
  while (!world_.happened("gone")) world_.step();
  for (int i = 0; i < 20; ++i) world_.step();
  EXPECT_FALSE(sees("Near"));
  EXPECT_TRUE(misses("Near"));
}

TEST_F(SheetJudge, BeaconsAreSeenAndWithoutThemNothingIs) {
  EXPECT_TRUE(sees("Racon"));
  // Out of the bands that it answers on, the racon is silent; the picture is otherwise the same.
  plan_.scenario.mutable_racons(0)->set_x_band(false);
  plan_.scenario.mutable_racons(0)->set_s_band(true);
  world_ = World(plan_.scenario);
  EXPECT_FALSE(sees("Racon"));
}

TEST_F(SheetJudge, ASartIsSeenByXBandAlone) {
  plan_ = exercise_plan(
      "name: Sart\nown_ships:\n"
      "  - {name: Own, position: {lat: 57.0, lon: 3.0},\n"
      "     radars: [{name: X, range_nm: 12}, {name: S, set: 30 kW S, range_nm: 12}]}\n"
      "sarts: [{name: Raft, position: {lat: 57.05, lon: 3.0}, height_m: 1.5}]\n",
      "sart.yaml");
  world_ = World(plan_.scenario);
  EXPECT_TRUE(sees("Raft"));
  scenario::ExerciseCheck check;
  check.set_radar("S");
  check.add_sees("Raft");
  EXPECT_FALSE(judged(check).passed());
}

TEST_F(SheetJudge, LandEventsAndDistancesAreJudged) {
  scenario::ExerciseCheck check;
  check.set_land(true);
  EXPECT_TRUE(judged(check).passed());
  check.set_land(false);
  EXPECT_FALSE(judged(check).passed());
  scenario::ExerciseCheck event;
  event.set_event("gone");
  EXPECT_FALSE(judged(event).passed());
  scenario::ExerciseCheck apart;
  scenario::Apart& pair = *apart.add_apart();
  pair.set_ship("Own");
  pair.set_other("Near");
  pair.set_least_nm(1.0);
  EXPECT_TRUE(judged(apart).passed());
  pair.set_most_nm(1.1);
  EXPECT_FALSE(judged(apart).passed());
}

TEST_F(SheetJudge, WhoIsOnLandIsComplainedOf) {
  EXPECT_TRUE(land_complaints(plan_.scenario, chart(), 5.0).empty());
  scenario::Scenario wrong = plan_.scenario;
  wrong.mutable_targets(0)->mutable_position()->set_lat(60.3929);  // Bergen's town
  wrong.mutable_targets(0)->mutable_position()->set_lon(5.3250);
  wrong.mutable_targets(1)->set_speed_kn(20.0);
  wire::Waypoint& over = *wrong.mutable_targets(1)->add_waypoints();
  over.set_lat(60.4700);
  over.set_lon(5.0100);
  wrong.mutable_own_ships(0)->set_course_deg(90.0);
  wrong.mutable_own_ships(0)->set_speed_kn(30.0);
  const auto complaints = land_complaints(wrong, chart(), 20.0);
  ASSERT_EQ(complaints.size(), 3u);
  EXPECT_EQ(complaints[0].find("targets[0] (Near): begins on land at 60.3929, 5.3250"), 0u)
      << complaints[0];
  EXPECT_EQ(complaints[1].find("targets[1] (Hidden): the leg to waypoints[0] is over land at"), 0u)
      << complaints[1];
  EXPECT_EQ(complaints[2].find("own ship Own: comes on land after"), 0u) << complaints[2];
}

}  // namespace
}  // namespace skerry::server
