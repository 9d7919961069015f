// An own ship that an outside simulator drives.
#include "server/world/driven_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "server/world/dead_reckoning.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/geodesy.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

World frida() {
  return World(
      parse_scenario("name: s\nown_ships:\n  - {name: Frida, position: {lat: 60, lon: 5}, "
                     "course_deg: 90, speed_kn: 10, radars: [{}]}\n",
                     "f"));
}

ScenarioTime now_of(const World& world) {
  return ScenarioTime(World::kTick * static_cast<std::int64_t>(world.tick()));
}

ShipState ship_of(const World& world) { return world.state().own_ships[0]; }

double turned(double from_deg, double to_deg) { return std::remainder(to_deg - from_deg, 360.0); }

// The simulator's own ship: on a steady turn from a place of its own.
struct Simulator {
  ShipState ship;
  Simulator(GeoPoint at, double heading, double speed_mps, double rate_deg_s) {
    ship.position = at;
    ship.heading_deg = heading;
    ship.course_over_ground_deg = std::fmod(heading + 4.0, 360.0);
    ship.speed_mps = speed_mps;
    ship.rate_of_turn_deg_s = rate_deg_s;
  }
  void sail(Duration dt) {
    const ShipPlace place = position_at(ship, dt);
    ship.position = place.position;
    ship.heading_deg = place.heading_deg;
    ship.course_over_ground_deg = place.course_over_ground_deg;
  }
  // A fix with the resolution of RMC: position to 1e-4 minutes, speed to 0.1 kn, course to 0.1 deg.
  OwnShipFix rmc() const {
    const auto rounded = [](double value, double unit) { return std::round(value / unit) * unit; };
    OwnShipFix fix;
    fix.position = GeoPoint{rounded(ship.position.latitude_deg, 1e-4 / 60.0),
                            rounded(ship.position.longitude_deg, 1e-4 / 60.0)};
    fix.speed_mps = rounded(ship.speed_mps, knots_in_mps(0.1));
    fix.course_over_ground_deg = rounded(ship.course_over_ground_deg, 0.1);
    fix.heading_deg = rounded(ship.heading_deg, 0.1);
    return fix;
  }
};

TEST(DrivenMotion, IsSmoothBetweenRoundedFixesASecondApartAndStaysWithThem) {
  World world = frida();
  Simulator simulator({59.5, 4.0}, 300.0, 9.0, 0.0);
  double farthest_m = 0.0, heading_off = 0.0, most_acceleration = 0.0;
  ShipState last = ship_of(world);
  for (int tick = 0; tick < 1200; ++tick) {
    if (tick % 10 == 3) world.drive(0, simulator.rmc(), now_of(world));
    world.step();
    simulator.sail(World::kTick);
    const ShipState ship = ship_of(world);
    if (tick > 100) {
      farthest_m = std::max(farthest_m, metres_between(ship.position, simulator.ship.position));
      heading_off =
          std::max(heading_off, std::fabs(turned(ship.heading_deg, simulator.ship.heading_deg)));
      most_acceleration = std::max(most_acceleration, std::fabs(ship.speed_mps - last.speed_mps));
      EXPECT_EQ(position_at(last, World::kTick).position, ship.position) << "a jump";
    }
    last = ship;
  }
  std::printf("%.3f m and %.3f deg off, %.3f m/s from tick to tick\n", farthest_m, heading_off,
              most_acceleration);
  EXPECT_LT(farthest_m, 0.25);  // RMC's rounding, and its speed's over a second
  EXPECT_LT(heading_off, 0.11);
  EXPECT_LT(most_acceleration, 0.2);
  EXPECT_TRUE(last.driven);
}

TEST(DrivenMotion, FollowsATurnByTheRateThatFixesGiveOrByHeadingsAlone) {
  for (const bool with_rate : {true, false}) {
    World world = frida();
    Simulator simulator({60.0, 5.0}, 350.0, 8.0, 0.93);
    double heading_off = 0.0;
    for (int tick = 0; tick < 1000; ++tick) {
      if (tick % 10 == 0) {
        OwnShipFix fix = simulator.rmc();
        if (with_rate) fix.rate_of_turn_deg_min = 55.8;
        world.drive(0, fix, now_of(world));
      }
      world.step();
      simulator.sail(World::kTick);
      if (tick < 200) continue;
      heading_off = std::max(
          heading_off, std::fabs(turned(ship_of(world).heading_deg, simulator.ship.heading_deg)));
    }
    std::printf("%s: %.3f deg off in a turn of 0.93 deg/s\n",
                with_rate ? "with the rate" : "without", heading_off);
    EXPECT_LT(heading_off, with_rate ? 0.12 : 0.4);
    EXPECT_NEAR(ship_of(world).rate_of_turn_deg_s, 0.93, 0.15);
  }
}

TEST(DrivenMotion, WorksSpeedAndCourseOutWhereOnlyPositionsCome) {
  World world = frida();
  Simulator simulator({60.01, 5.0}, 210.0, 7.0, 0.0);
  for (int tick = 0; tick < 150; ++tick) {
    if (tick % 10 == 0) world.drive(0, {.position = simulator.ship.position}, now_of(world));
    world.step();
    simulator.sail(World::kTick);
  }
  const ShipState ship = ship_of(world);
  EXPECT_LT(metres_between(ship.position, simulator.ship.position), 0.5);
  EXPECT_NEAR(ship.speed_mps, 7.0, 0.1);
  EXPECT_NEAR(turned(ship.course_over_ground_deg, 214.0), 0.0, 1.0);
  EXPECT_EQ(ship.heading_deg, 90.0) << "nobody said another";
}

TEST(DrivenMotion, PutsHerWhereSheIsAtOnceWhenThatIsFar) {
  World world = frida();
  world.drive(0, {.position = GeoPoint{-33.9, 18.4}, .heading_deg = 200.0, .speed_mps = 0.0},
              now_of(world));
  world.step();
  world.step();
  const ShipState ship = ship_of(world);
  EXPECT_LT(metres_between(ship.position, {-33.9, 18.4}), 1e-6);
  EXPECT_NEAR(ship.heading_deg, 200.0, 1e-9);
  EXPECT_EQ(ship.speed_mps, 0.0);
}

TEST(DrivenMotion, SailsAcrossTheAntimeridianAndThroughNorth) {
  World world = frida();
  Simulator simulator({10.0, 179.9995}, 80.0, 15.0, 0.0);
  simulator.ship.course_over_ground_deg = 80.0;
  for (int tick = 0; tick < 200; ++tick) {
    if (tick % 10 == 0) world.drive(0, simulator.rmc(), now_of(world));
    world.step();
    simulator.sail(World::kTick);
  }
  EXPECT_LT(simulator.ship.position.longitude_deg, -179.0);
  EXPECT_LT(metres_between(ship_of(world).position, simulator.ship.position), 0.5);
}

TEST(DrivenMotion, GoesOnByHerselfTenSecondsAfterTheLastFix) {
  World world = frida();
  const Simulator simulator({60.0, 5.0}, 30.0, 6.0, 0.0);
  OwnShipFix fix = simulator.rmc();
  fix.course_over_ground_deg = 30.0;
  world.drive(0, fix, now_of(world));
  for (int tick = 0; tick < 99; ++tick) world.step();
  EXPECT_TRUE(ship_of(world).driven);
  world.step();
  EXPECT_FALSE(ship_of(world).driven);
  const GeoPoint from = ship_of(world).position;
  for (int tick = 0; tick < 100; ++tick) world.step();
  const ShipState ship = ship_of(world);
  EXPECT_NEAR(ship.heading_deg, 30.0, 0.01);
  EXPECT_NEAR(ship.ordered_course_deg, 30.0, 0.01);
  EXPECT_NEAR(metres_between(from, ship.position), 60.0, 1.0);
  world.order(0, 100.0, 0.0);
  for (int tick = 0; tick < 3000; ++tick) world.step();
  EXPECT_NEAR(ship_of(world).heading_deg, 100.0, 0.1) << "orders count again";
}

TEST(DrivenMotion, RefusesNonsenseAndChangesNothingThen) {
  World world = frida();
  const double nan = std::nan("");
  for (const OwnShipFix& fix :
       {OwnShipFix{.position = GeoPoint{91.0, 5.0}}, OwnShipFix{.position = GeoPoint{60.0, nan}},
        OwnShipFix{.position = GeoPoint{60.0, 1e300}}, OwnShipFix{.heading_deg = -0.1},
        OwnShipFix{.heading_deg = nan}, OwnShipFix{.course_over_ground_deg = 361.0},
        OwnShipFix{.speed_mps = -1.0}, OwnShipFix{.speed_mps = 101.0},
        OwnShipFix{.rate_of_turn_deg_min = 1201.0}}) {
    EXPECT_THROW(world.drive(0, fix, now_of(world)), std::invalid_argument);
  }
  EXPECT_THROW(world.drive(1, {}, now_of(world)), std::invalid_argument);
  world.step();
  EXPECT_FALSE(ship_of(world).driven);
}

}  // namespace
}  // namespace skerry::server
