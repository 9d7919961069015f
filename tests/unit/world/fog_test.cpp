#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "server/world/traffic/give_way.hpp"
#include "server/world/world_change.hpp"
#include "tests/unit/world/traffic_kit.hpp"

namespace skerry::server {
namespace {

const std::string kDenseFog = "atmosphere: {visibility_nm: 0.1}\n";

// Of one ship: the most that she was off her course, to either side, deg.
struct Turned {
  double to_starboard = 0.0, to_port = 0.0;
  double slowest_kn = 99.0;
  bool back_on_course = false;
};

struct FogMeeting {
  double nearest_nm = 1e9;
  Turned first, second;
};

FogMeeting meet_in_fog(const std::string& scene, double first_course, double second_course,
                       int ticks = 60'000) {
  TrafficRun run(scene);
  FogMeeting meeting;
  const auto look = [](const ShipState& ship, double course, Turned& turned) {
    const double off = std::remainder(ship.heading_deg - course, 360.0);
    turned.to_starboard = std::max(turned.to_starboard, off);
    turned.to_port = std::max(turned.to_port, -off);
    turned.slowest_kn = std::min(turned.slowest_kn, ship.speed_mps / knots_in_mps(1.0));
    turned.back_on_course = std::fabs(off) < 1.0;
  };
  for (int tick = 0; tick < ticks; ++tick) {
    run.step();
    const ShipState a = run.ship(0), b = run.ship(1);
    meeting.nearest_nm = std::min(meeting.nearest_nm, metres_apart(a.position, b.position) / kMile);
    look(a, first_course, meeting.first);
    look(b, second_course, meeting.second);
  }
  return meeting;
}

void tell_meeting(const char* what, const FogMeeting& meeting) {
  std::printf("%s: %.2f NM; first %.0f deg to starboard, %.0f to port, second %.0f and %.0f\n",
              what, meeting.nearest_nm, meeting.first.to_starboard, meeting.first.to_port,
              meeting.second.to_starboard, meeting.second.to_port);
}

TEST(Fog, LeavesTheSidesThatRule19Leaves) {
  const auto sides = [](std::initializer_list<Unseen> others) {
    const OpenSides open = open_sides(std::vector<Unseen>(others));
    return std::string(open.starboard ? "S" : "") + (open.port ? "P" : "");
  };
  EXPECT_EQ(sides({}), "SP");
  EXPECT_EQ(sides({{0.0}}), "S") << "head on";
  EXPECT_EQ(sides({{45.0}}), "S") << "forward of the beam, on either bow: not to port";
  EXPECT_EQ(sides({{-89.0}}), "S");
  EXPECT_EQ(sides({{10.0, true}}), "SP") << "but for one that she overtakes";
  EXPECT_EQ(sides({{90.0}}), "P") << "not towards one abeam";
  EXPECT_EQ(sides({{-90.0}}), "S");
  EXPECT_EQ(sides({{150.0}}), "P") << "nor abaft it";
  EXPECT_EQ(sides({{-150.0}}), "S");
  EXPECT_EQ(sides({{180.0}}), "SP");
  EXPECT_EQ(sides({{20.0}, {120.0}}), "") << "she can only slow down";
}

TEST(Fog, BeginsBelowThreeMilesAndHidesWhatIsFartherThanTheVisibility) {
  const auto at = [](double nm) { return Visibility{nm * kMile}; };
  EXPECT_TRUE(Visibility{}.in_sight(1e9));
  EXPECT_TRUE(at(3.0).in_sight(7.0 * kMile));
  EXPECT_FALSE(at(2.99).in_sight(7.0 * kMile));
  EXPECT_TRUE(at(2.0).in_sight(1.99 * kMile));
  EXPECT_FALSE(at(2.0).in_sight(2.01 * kMile));
}

TEST(Fog, SafeSpeedFallsEvenlyToHalfAndKeepsSteerageWay) {
  const auto speed_kn = [](double kn, double visibility_nm) {
    return safe_speed_mps(knots_in_mps(kn), {visibility_nm * kMile}) / knots_in_mps(1.0);
  };
  EXPECT_EQ(safe_speed_mps(8.0, {3.0 * kMile}), 8.0);
  EXPECT_NEAR(speed_kn(16.0, 1.5), 12.0, 1e-9);
  EXPECT_NEAR(speed_kn(16.0, 0.3), 8.8, 1e-9);
  EXPECT_NEAR(speed_kn(10.0, 0.02), 6.0, 1e-9);
  EXPECT_NEAR(speed_kn(4.0, 0.02), 4.0, 1e-9);
}

TEST(Fog, HeadOnBothTurnToStarboard) {
  const FogMeeting meeting = meet_in_fog(
      kDenseFog + "targets:\n" + ship_line("A", -5, 0, 0, 12) + ship_line("B", 5, 0, 180, 12), 0,
      180);
  tell_meeting("head on in fog", meeting);
  EXPECT_GT(meeting.nearest_nm, 0.4);
  EXPECT_GT(meeting.first.to_starboard, 25.0);
  EXPECT_GT(meeting.second.to_starboard, 25.0);
  EXPECT_LT(meeting.first.to_port, 1.0);
  EXPECT_LT(meeting.second.to_port, 1.0);
  EXPECT_TRUE(meeting.first.back_on_course);
  EXPECT_TRUE(meeting.second.back_on_course);
}

TEST(Fog, CrossingBothAlterToStarboardAlsoWhoWouldStandOn) {
  const std::string ships = "targets:\n" + ship_line("A", -5, 0, 0, 12);
  // She is on A's starboard side, and then on her port side.
  const FogMeeting right = meet_in_fog(kDenseFog + ships + ship_line("B", 0, 5, 270, 12), 0, 270);
  tell_meeting("crossing in fog from starboard", right);
  const FogMeeting left = meet_in_fog(kDenseFog + ships + ship_line("B", 0, -5, 90, 12), 0, 90);
  tell_meeting("crossing in fog from port", left);
  for (const FogMeeting& meeting : {right, left}) {
    EXPECT_GT(meeting.nearest_nm, 0.4);
    EXPECT_GT(meeting.first.to_starboard, 25.0);
    EXPECT_GT(meeting.second.to_starboard, 25.0);
    EXPECT_LT(meeting.first.to_port, 1.0) << "forward of the beam: never to port";
    EXPECT_LT(meeting.second.to_port, 1.0);
    EXPECT_TRUE(meeting.first.back_on_course);
    EXPECT_TRUE(meeting.second.back_on_course);
  }
  const FogMeeting seen = meet_in_fog(ships + ship_line("B", 0, 5, 270, 12), 0, 270);
  EXPECT_LT(seen.second.to_starboard, 1e-6) << "rule 17: in sight she stands on";
}

// She acts alone: the other knows no rules.
TEST(Fog, WhoWouldStandOnKeepsClearAlone) {
  const FogMeeting meeting = meet_in_fog(kDenseFog + "targets:\n" + ship_line("A", -5, 0, 0, 6) +
                                             ship_line("B", 0, -5, 90, 6, "gives_way: never"),
                                         0, 90);
  tell_meeting("one from port in fog that does nothing", meeting);
  EXPECT_GT(meeting.nearest_nm, 0.4);
  EXPECT_GT(meeting.first.to_starboard, 25.0);
  EXPECT_LT(meeting.first.to_port, 1.0);
  EXPECT_LT(meeting.second.to_starboard, 1e-6);
}

TEST(Fog, OvertakingBothKeepClearAndNobodyTurnsTowardsTheOther) {
  // Astern of B by 3 NM, a little to her starboard.
  const FogMeeting meeting = meet_in_fog(
      kDenseFog + "targets:\n" + ship_line("A", -3, 0.35, 0, 20, "gives_way: early", "container") +
          ship_line("B", 0, 0, 0, 6),
      0, 0);
  tell_meeting("overtaking in fog", meeting);
  EXPECT_GT(meeting.nearest_nm, 0.4);
  EXPECT_GT(std::max(meeting.first.to_starboard, meeting.first.to_port), 10.0);
  EXPECT_LT(meeting.second.to_starboard, 1.0) << "not towards one abaft the beam";
  EXPECT_TRUE(meeting.first.back_on_course);
  EXPECT_TRUE(meeting.second.back_on_course);
}

TEST(Fog, WhoIsOvertakenTurnsAwayFromOneWhoDoesNothing) {
  const std::string overtaker = ship_line("A", -3, 0.2, 0, 20, "gives_way: never", "container");
  const FogMeeting meeting =
      meet_in_fog(kDenseFog + "targets:\n" + overtaker + ship_line("B", 0, 0, 0, 6), 0, 0);
  tell_meeting("overtaken in fog from starboard", meeting);
  EXPECT_GT(meeting.nearest_nm, 0.4);
  EXPECT_GT(meeting.second.to_port, 25.0);
  EXPECT_LT(meeting.second.to_starboard, 1.0);
  const FogMeeting seen = meet_in_fog("targets:\n" + overtaker + ship_line("B", 0, 0, 0, 6), 0, 0);
  EXPECT_LT(seen.second.to_port, 1e-6) << "rule 17: in sight she stands on";
}

TEST(Fog, SlowsThoseWhoObeyTheRulesUnlessTheyAreOrdered) {
  TrafficRun run(kDenseFog + "targets:\n" + ship_line("A", 0, 0, 0, 12) +
                 ship_line("B", 20, 0, 0, 12, "gives_way: never"));
  run.step_to(1200.0);
  EXPECT_NEAR(run.ship(0).speed_mps / knots_in_mps(1.0), 12.0 * (0.5 + 0.5 * 0.1 / 3.0), 0.01);
  EXPECT_NEAR(run.ship(1).speed_mps / knots_in_mps(1.0), 12.0, 1e-6);
  run.environment.visibility_nm = kClearVisibility_nm;
  run.step_to(2400.0);
  EXPECT_NEAR(run.ship(0).speed_mps / knots_in_mps(1.0), 12.0, 0.01);
  run.environment.visibility_nm = 0.1;
  wire::TargetChange order;
  order.set_target(0);
  order.set_speed_kn(11.0);
  run.traffic.order(order, run.now);
  run.step_to(3600.0);
  EXPECT_NEAR(run.ship(0).speed_mps / knots_in_mps(1.0), 11.0, 0.01);
}

TEST(Fog, IsAKeyOfTheScenarioAndAChangeOfTheWeather) {
  EXPECT_EQ(environment_of(traffic_scene("")).visibility_nm, kClearVisibility_nm);
  Environment environment = environment_of(traffic_scene(kDenseFog));
  EXPECT_EQ(environment.visibility_nm, 0.1);
  EXPECT_EQ(world_message(environment, {}).visibility_nm(), 0.1);
  wire::WorldChange change;
  change.set_visibility_nm(0.5);
  EXPECT_FALSE(change_environment(change, {}, environment));
  EXPECT_EQ(world_message(environment, {}).visibility_nm(), 0.5);
  change.set_visibility_nm(30.0);
  EXPECT_FALSE(change_environment(change, {}, environment));
  EXPECT_FALSE(world_message(environment, {}).has_visibility_nm()) << "clear";
  EXPECT_THROW(traffic_scene("atmosphere: {visibility_nm: 0.01}\n"), std::exception);
  EXPECT_THROW(traffic_scene("atmosphere: {visibility_nm: 31}\n"), std::exception);
}

}  // namespace
}  // namespace skerry::server
