// Ships that sail as a log has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/world/dead_reckoning.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/refusal.hpp"
#include "tests/unit/world/traffic_kit.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

// Lies until minute 3 (as far as a ship is still), then sails north-east and turns south.
const std::string kLogged =
    "targets:\n"
    "  - {name: Log, mmsi: 219000001, ship_class: coaster, as_logged: true, start_min: 1,\n"
    "     course_deg: 77, position: {lat: 58.0, lon: 1.0}, waypoints: [\n"
    "       {lat: 58.00001, lon: 1.0, arrive_min: 3},\n"
    "       {lat: 58.02, lon: 1.04, arrive_min: 10},\n"
    "       {lat: 58.0, lon: 1.04, arrive_min: 16}]}\n";

std::string refused(const std::string& targets) {
  return refusal("name: a\nown_ships: [{name: B, position: {lat: 58, lon: 2}, radars: [{}]}]\n" +
                 targets);
}

bool is_there(const TrafficRun& run) { return !run.traffic.states(run.now).empty(); }

TEST(LoggedTrack, IsOnTheWaterFromHerFirstFixToHerLast) {
  TrafficRun run(kLogged);
  EXPECT_FALSE(is_there(run));
  run.step_to(59.9);
  EXPECT_FALSE(is_there(run));
  EXPECT_TRUE(run.told(0).removed());
  run.step_to(60.0);
  EXPECT_TRUE(is_there(run));
  EXPECT_FALSE(run.told(0).removed());
  run.step_to(959.9);
  EXPECT_TRUE(is_there(run));
  run.step_to(960.0);
  EXPECT_FALSE(is_there(run));
}

TEST(LoggedTrack, IsAtEachWaypointAtItsTime) {
  TrafficRun run(kLogged);
  const GeoPoint places[] = {{58.0, 1.0}, {58.00001, 1.0}, {58.02, 1.04}, {58.01, 1.04}};
  const double minutes[] = {1, 3, 10, 13};
  for (int i = 0; i < 4; ++i) {
    run.step_to(60 * minutes[i]);
    EXPECT_LT(metres_apart(run.ship(0).position, places[i]), 1e-3) << minutes[i];
  }
  EXPECT_NEAR(run.ship(0).heading_deg, 180.0, 1e-6);
  // 0.02 deg in 6 minutes.
  EXPECT_NEAR(run.ship(0).speed_mps, 111'370.0 * 0.02 / 360, 0.01);
}

TEST(LoggedTrack, LiesOnTheHeadingThatTheLogHas) {
  TrafficRun run(kLogged);
  run.step_to(100);
  EXPECT_EQ(run.ship(0).heading_deg, 77.0);
  run.step_to(300);
  EXPECT_NEAR(run.ship(0).heading_deg, 46.7, 0.5);
}

TEST(LoggedTrack, EachTickLeadsToTheNext) {
  TrafficRun run(kLogged);
  run.step_to(70);
  double worst_m = 0.0;
  for (ShipState before = run.ship(0); run.now < 950s; before = run.ship(0)) {
    run.step();
    const bool turned = run.now == 180s || run.now == 600s;
    if (turned) continue;
    worst_m = std::max(
        worst_m, metres_apart(position_at(before, kTrafficTick).position, run.ship(0).position));
  }
  RecordProperty("worst_um", static_cast<int>(worst_m * 1e6));
  EXPECT_LT(worst_m, 1e-4);
}

TEST(LoggedTrack, TakesOrdersWhileSheIsThereAndVanishesAtHerRoutesEnd) {
  TrafficRun run(kLogged);
  wire::TargetChange change;
  change.set_target(0);
  change.set_speed_kn(5);
  const auto fault = run.traffic.fault_of(change);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("not on the water at 0.0 min"), std::string::npos) << *fault;
  run.step_to(200);
  ASSERT_FALSE(run.traffic.fault_of(change));
  run.traffic.order(change, run.now);
  run.step_to(560);
  EXPECT_NEAR(run.ship(0).speed_mps / 0.514444, 5.0, 0.5);
  wire::TargetChange on;
  on.set_target(0);
  on.set_resume(true);
  run.traffic.order(on, run.now);
  EXPECT_EQ(run.told(0).route_size(), 2);
  run.step_to(2400);
  EXPECT_FALSE(is_there(run)) << "she sailed on to the end of her log";
}

TEST(LoggedTrack, ACopyIsASnapshotAndRunsAlike) {
  TrafficRun run(kLogged);
  run.step_to(200);
  TrafficRun copy = run;
  run.step_to(700);
  copy.step_to(700);
  EXPECT_EQ(run.ship(0).position, copy.ship(0).position);
}

TEST(LoggedTrack, ASecondPartOfALogMayHaveHerNumber) {
  const std::string later =
      "  - {name: Log, mmsi: 219000001, as_logged: true, start_min: 16,\n"
      "     position: {lat: 58.1, lon: 1.0}, waypoints: [{lat: 58.1, lon: 1.0, arrive_min: 30}]}\n";
  EXPECT_EQ(traffic_scene(kLogged + later).targets_size(), 2);
  const std::string together = std::string(later).replace(later.find("16,"), 3, "15,");
  EXPECT_NE(refused(kLogged + together).find("numbers must differ"), std::string::npos);
}

TEST(LoggedTrack, WhatContradictsALogIsRefused) {
  const auto said = [](const std::string& from, const std::string& to) {
    std::string text = kLogged;
    text.replace(text.find(from), from.size(), to);
    return refused(text);
  };
  EXPECT_NE(said("arrive_min: 10}", "arrive_min: 3}").find("later than 3 min"), std::string::npos);
  EXPECT_NE(said(", arrive_min: 10}", "}").find("needs it at each waypoint"), std::string::npos);
  EXPECT_NE(said("arrive_min: 10}", "arrive_min: 3.1}").find("up to 200 kn"), std::string::npos);
  EXPECT_NE(said("course_deg: 77", "speed_kn: 7").find("besides as_logged"), std::string::npos);
  EXPECT_NE(said("course_deg: 77", "gives_way: early").find("besides as_logged"),
            std::string::npos);
  EXPECT_NE(said("arrive_min: 3}", "arrive_min: 3, stop_min: 1}").find("arrive_min alone"),
            std::string::npos);
  EXPECT_NE(refused("targets: [{name: A, as_logged: true, position: {lat: 58, lon: 1}}]\n")
                .find("without waypoints"),
            std::string::npos);
}

}  // namespace
}  // namespace skerry::server
