#include "server/world/traffic/give_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/unit/world/traffic_kit.hpp"

namespace skerry::server {
namespace {

struct Meeting {
  double nearest_m = 1e9;
  double most_altered_first = 0.0, most_altered_second = 0.0;  // deg, either way
  double to_port_first = 0.0;                                  // the most
  bool back_on_course = false;
};

Meeting meet(const std::string& first, const std::string& second, double first_course,
             double second_course) {
  TrafficRun run("targets:\n" + first + second);
  Meeting meeting;
  for (int tick = 0; tick < 60'000; ++tick) {
    run.step();
    const ShipState a = run.ship(0), b = run.ship(1);
    meeting.nearest_m = std::min(meeting.nearest_m, metres_apart(a.position, b.position));
    const double turned = std::remainder(a.heading_deg - first_course, 360.0);
    meeting.most_altered_first = std::max(meeting.most_altered_first, std::fabs(turned));
    meeting.to_port_first = std::max(meeting.to_port_first, -turned);
    meeting.most_altered_second =
        std::max(meeting.most_altered_second, off_deg(b.heading_deg, second_course));
  }
  meeting.back_on_course = off_deg(run.ship(0).heading_deg, first_course) < 1.0;
  return meeting;
}

TEST(GiveWay, KnowsWhoIsToGiveWay) {
  SeenShip ship, other;
  ship.speed_mps = 6.0;
  other.speed_mps = 6.0;
  other.course_deg = 270.0;
  const auto on = [&](double east, double north) {
    return encounter_of(ship, 0.0, other, PlanePoint{east, north});
  };
  EXPECT_EQ(on(1000, 1000), Encounter::crossing);
  other.course_deg = 90.0;
  EXPECT_EQ(on(-1000, 1000), Encounter::none) << "rule 17: she stands on";
  other.course_deg = 180.0;
  EXPECT_EQ(on(0, 1000), Encounter::head_on);
  other.course_deg = 0.0;
  other.speed_mps = 3.0;
  EXPECT_EQ(on(0, 1000), Encounter::overtaking);
  other.speed_mps = 9.0;
  EXPECT_EQ(on(0, -1000), Encounter::none) << "the overtaker keeps clear";
  other.course_deg = 90.0;
  other.privilege = Privilege::fishing;
  EXPECT_EQ(on(-1000, 1000), Encounter::privileged);
  other.privilege = Privilege::power;
  other.speed_mps = 0.0;
  EXPECT_EQ(on(-1000, 1000), Encounter::privileged);
}

TEST(GiveWay, FindsTheNearestPoint) {
  const Passing approach = passing_of({1000.0, 5000.0}, {0.0, 5.0}, {0.0, -5.0});
  EXPECT_NEAR(approach.distance_m, 1000.0, 1e-9);
  EXPECT_NEAR(approach.time_s, 500.0, 1e-9);
  EXPECT_EQ(passing_of({3.0, 4.0}, {1.0, 1.0}, {1.0, 1.0}).distance_m, 5.0);
}

TEST(GiveWay, CrossingTheOneWithTheOtherToStarboardGoesAstern) {
  // They would meet in the middle after half an hour.
  const std::string a = ship_line("A", -6, 0, 0, 12), b = ship_line("B", 0, 6, 270, 12);
  const Meeting meeting = meet(a, b, 0.0, 270.0);
  std::printf("crossing: %.2f NM, altered by %.0f deg\n", meeting.nearest_m / kMile,
              meeting.most_altered_first);
  EXPECT_GT(meeting.nearest_m, 0.4 * kMile);
  EXPECT_GT(meeting.most_altered_first, 14.0);
  EXPECT_LT(meeting.to_port_first, 1.0);
  EXPECT_LT(meeting.most_altered_second, 1e-6) << "rule 17: she keeps her course";
  EXPECT_TRUE(meeting.back_on_course);
}

TEST(GiveWay, HeadOnBothTurnToStarboard) {
  const Meeting meeting =
      meet(ship_line("A", -6, 0, 0, 12), ship_line("B", 6, 0, 180, 12), 0.0, 180.0);
  std::printf("head on: %.2f NM\n", meeting.nearest_m / kMile);
  EXPECT_GT(meeting.nearest_m, 0.4 * kMile);
  EXPECT_GT(meeting.most_altered_first, 10.0);
  EXPECT_GT(meeting.most_altered_second, 10.0);
  EXPECT_LT(meeting.to_port_first, 1.0);
  EXPECT_TRUE(meeting.back_on_course);
}

TEST(GiveWay, TheOvertakerKeepsClear) {
  const Meeting meeting = meet(ship_line("A", -3, 0, 0, 16, "gives_way: early", "container"),
                               ship_line("B", 0, 0, 0, 8), 0.0, 0.0);
  std::printf("overtaking: %.2f NM\n", meeting.nearest_m / kMile);
  EXPECT_GT(meeting.nearest_m, 0.4 * kMile);
  EXPECT_GT(meeting.most_altered_first, 10.0);
  EXPECT_LT(meeting.most_altered_second, 1e-6);
  EXPECT_TRUE(meeting.back_on_course);
}

TEST(GiveWay, LateIsLaterAndCloser) {
  const std::string late = "gives_way: late";
  const Meeting meeting =
      meet(ship_line("A", -6, 0, 0, 12, late), ship_line("B", 0, 6, 270, 12, late), 0.0, 270.0);
  std::printf("late: %.2f NM\n", meeting.nearest_m / kMile);
  EXPECT_GT(meeting.nearest_m, 0.1 * kMile);
  EXPECT_LT(meeting.nearest_m, 0.45 * kMile);
}

TEST(GiveWay, ThoseWhoNeverDoCollideAsSetUp) {
  const std::string never = "gives_way: never";
  EXPECT_LT(meet(ship_line("A", -6, 0, 0, 12, never), ship_line("B", 0, 6, 270, 12, never), 0, 270)
                .nearest_m,
            30.0);
  EXPECT_LT(meet(ship_line("A", -6, 0, 0, 12, never), ship_line("B", 6, 0, 180, 12, never), 0, 180)
                .nearest_m,
            30.0);
}

TEST(GiveWay, ReturnsToHerRoute) {
  const GeoPoint end = advanced({60.0, 5.0}, ShortWay{12.0 * kMile, 0.0});
  const GeoPoint begin = advanced({60.0, 5.0}, ShortWay{-6.0 * kMile, 0.0});
  TrafficRun run(
      "targets:\n  - {name: A, ship_class: coaster, gives_way: early, speed_kn: 12, "
      "position: {lat: " +
      std::to_string(begin.latitude_deg) +
      ", lon: 5}, waypoints: "
      "[{lat: " +
      std::to_string(end.latitude_deg) + ", lon: 5}]}\n" + ship_line("B", 0, 6, 270, 12));
  double nearest = 1e9, widest = 0.0;
  for (int tick = 0; tick < 54'000; ++tick) {
    run.step();
    nearest = std::min(nearest, metres_apart(run.ship(0).position, run.ship(1).position));
    widest = std::max(widest, std::fabs(short_way_between({60, 5}, run.ship(0).position).east_m));
  }
  EXPECT_GT(nearest, 0.4 * kMile);
  EXPECT_GT(widest, 300.0);
  run.step_to(5700.0);
  EXPECT_LT(metres_apart(run.ship(0).position, end), 0.2 * kMile);
}

TEST(GiveWay, KeepsClearOfAnOwnShip) {
  TrafficRun run("targets:\n" + ship_line("A", -6, 0, 0, 12));
  ShipState own;
  own.position = advanced({60.0, 5.0}, ShortWay{0.0, 6.0 * kMile});
  own.heading_deg = own.course_over_ground_deg = 270.0;
  own.speed_mps = knots_in_mps(12.0);
  own.length_m = 80.0;
  run.own_ships = {own};
  double nearest = 1e9;
  for (int tick = 0; tick < 36'000; ++tick) {
    run.step();
    run.own_ships[0].position =
        advanced(run.own_ships[0].position, ShortWay{0.0, -0.1 * own.speed_mps});
    nearest = std::min(nearest, metres_apart(run.ship(0).position, run.own_ships[0].position));
  }
  EXPECT_GT(nearest, 0.4 * kMile);
}

}  // namespace
}  // namespace skerry::server
