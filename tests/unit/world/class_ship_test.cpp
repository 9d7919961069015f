#include "server/world/class_ship.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Rhumb.hpp>
#include <bit>
#include <cmath>
#include <string>

#include "server/world/dead_reckoning.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

scenario::Scenario scene(const std::string& ship, const std::string& rest = "") {
  return parse_scenario(
      "name: one ship\n" + rest +
          "own_ships:\n  - name: Frida\n    position: {lat: 60.5, lon: 4.5}\n    radars: [{}]\n" +
          ship,
      "test.yaml");
}

ShipState after(World& world, int ticks) {
  for (int i = 0; i < ticks; ++i) world.step();
  return world.state().own_ships.front();
}

TEST(ShortWay, IsARhumbLine) {
  const GeographicLib::Rhumb& rhumb = GeographicLib::Rhumb::WGS84();
  double worst_m = 0.0;
  for (double latitude = -79.9; latitude < 80.0; latitude += 3.7) {
    for (double course = 0.0; course < 360.0; course += 17.0) {
      for (const double distance : {0.001, 1.0, 50.0}) {
        double lat = 0.0, lon = 0.0, off = 0.0, azimuth = 0.0;
        rhumb.Direct(latitude, 179.9999, course, distance, lat, lon);
        const GeoPoint ours = advanced(GeoPoint{latitude, 179.9999}, course, distance).position;
        rhumb.Inverse(lat, lon, ours.latitude_deg, ours.longitude_deg, off, azimuth);
        worst_m = std::max(worst_m, off);
      }
    }
  }
  std::printf("worst: %.1e m\n", worst_m);
  EXPECT_LT(worst_m, 1e-8);
}

TEST(ShortWay, BetweenPlacesIsGoodEnoughToSteerBy) {
  double length = 0.0, course = 0.0;
  GeographicLib::Rhumb::WGS84().Inverse(60.0, 179.5, 61.0, -178.0, length, course);
  const ShortWay way = short_way_between({60.0, 179.5}, {61.0, -178.0});
  const double radians = course * 3.14159265358979 / 180.0;
  EXPECT_NEAR(way.north_m, length * std::cos(radians), 1e-4 * length);
  EXPECT_NEAR(way.east_m, length * std::sin(radians), 1e-4 * length);
}

TEST(ClassShip, HasTheSizesOfHerClassAndItsWay) {
  World world(scene("    ship_class: coaster\n    course_deg: 30\n    speed_kn: 10\n"));
  const ShipState ship = after(world, 600);
  EXPECT_EQ(ship.length_m, 80.0);
  EXPECT_EQ(ship.beam_m, 13.0);
  ASSERT_TRUE(ship.con);
  EXPECT_EQ(ship.con->ship_class->key, "coaster");
  EXPECT_NEAR(ship.heading_deg, 30.0, 0.05);
  EXPECT_NEAR(ship.speed_mps, 10.0 * 1852 / 3600, 0.02);
}

TEST(ClassShip, TheNextTickIsWhereThisOneLeads) {
  World world(scene("    ship_class: ferry\n    course_deg: 350\n    speed_kn: 15\n",
                    "sea: {state: 5, wind_from_deg: 80, current_set_deg: 200, current_kn: 2}\n"));
  world.order(0, 170.0, 8.0);
  ShipState before = world.state().own_ships.front();
  for (int i = 0; i < 3000; ++i) {
    const ShipPlace leads_to = position_at(before, World::kTick);
    world.step();
    const ShipState now = world.state().own_ships.front();
    ASSERT_EQ(now.position.latitude_deg, leads_to.position.latitude_deg) << i;
    ASSERT_EQ(now.position.longitude_deg, leads_to.position.longitude_deg) << i;
    ASSERT_EQ(now.heading_deg, leads_to.heading_deg) << i;
    before = now;
  }
}

TEST(ClassShip, ACurrentIsInHerWayOverGroundAlone) {
  // 10 kn to the north through the water, 3 kn of current to the east.
  World world(scene("    ship_class: container\n    speed_kn: 10\n",
                    "sea: {current_set_deg: 90, current_kn: 3}\n"));
  wire::ConOrder hands_off;
  hands_off.set_heading_deg(0.0);
  world.order(0, hands_off);
  const ShipState ship = after(world, 6000);
  EXPECT_NEAR(ship.course_over_ground_deg, 16.70, 0.05);
  EXPECT_NEAR(ship.speed_mps * 3600 / 1852, 10.440, 0.01);
  EXPECT_NEAR(ship.con->motion.u * 3600 / 1852, 10.0, 0.01);
}

TEST(ClassShip, ObeysWheelLeverAndThrusters) {
  World world(scene("    ship_class: coaster\n    speed_kn: 8\n"));
  wire::ConOrder order;
  order.set_rudder_deg(20.0);
  order.set_engine_percent(100.0);
  world.order(0, order);
  ShipState ship = after(world, 600);
  EXPECT_EQ(ship.con->steering, SteeringMode::hand);
  EXPECT_DOUBLE_EQ(ship.con->rudder_deg, 20.0);
  EXPECT_GT(ship.rate_of_turn_deg_s, 0.5);
  EXPECT_NEAR(ship.con->shaft_rps, ship.con->ship_class->ahead_rps, 1e-3);
  order.Clear();
  order.set_steering(wire::STEERING_HEADING);
  order.set_engine_percent(0.0);
  world.order(0, order);
  ship = after(world, 1);
  EXPECT_EQ(ship.con->steering, SteeringMode::heading);
  after(world, 12000);
  order.Clear();
  order.set_bow_thruster_percent(100.0);
  world.order(0, order);
  order.Clear();
  order.set_rudder_deg(0.0);
  world.order(0, order);
  const double heading = after(world, 1).heading_deg;
  ship = after(world, 600);
  EXPECT_GT(std::remainder(ship.heading_deg - heading, 360.0), 5.0);
}

TEST(ClassShip, RefusesWhatSheCannotDo) {
  World world(scene("    ship_class: pilot\n"));
  wire::ConOrder order;
  order.set_bow_thruster_percent(10.0);
  EXPECT_EQ(world.fault_of(0, order), "bow thruster: a pilot has none");
  order.Clear();
  order.set_steering(wire::STEERING_TRACK);
  EXPECT_EQ(world.fault_of(0, order), "steering: she has no route; give her one in the scenario");
  order.Clear();
  order.set_rudder_deg(5.0);
  order.set_heading_deg(5.0);
  EXPECT_EQ(world.fault_of(0, order),
            "rudder: given together with an order to the autopilot; expected one of the two");
  EXPECT_THROW(world.order(0, order), std::invalid_argument);
  order.Clear();
  order.set_rudder_deg(5.0);
  World simple(scene("    speed_kn: 5\n"));
  EXPECT_EQ(simple.fault_of(0, order),
            "Frida has no ship class, so she has neither wheel nor lever; order course and speed, "
            "or give her a ship_class in the scenario");
}

TEST(ClassShip, SailsHerRouteToItsEnd) {
  World world(
      scene("    ship_class: tug\n    speed_kn: 10\n    route: [{lat: 60.51, lon: 4.5}, "
            "{lat: 60.51, lon: 4.52}, {lat: 60.5, lon: 4.52}]\n",
            "sea: {state: 3, wind_from_deg: 300, current_set_deg: 60, current_kn: 1.5}\n"));
  double worst_m = 0.0;
  std::uint32_t waypoint = 1;
  for (int i = 0; i < 20000; ++i) {
    world.step();
    const ConState con = *world.state().own_ships.front().con;
    if (con.waypoint == 0) break;
    if (con.waypoint != waypoint) {
      EXPECT_EQ(con.waypoint, waypoint + 1);
      EXPECT_LT(con.waypoint_m, 1.1 * 1111.0);
      waypoint = con.waypoint;
    }
    if (con.waypoint_m < 400.0) worst_m = std::max(worst_m, std::fabs(con.cross_track_m));
  }
  EXPECT_EQ(waypoint, 3u);
  std::printf("off her track at most %.1f m\n", worst_m);
  EXPECT_LT(worst_m, 15.0);
  const ShipState end = world.state().own_ships.front();
  EXPECT_EQ(end.con->steering, SteeringMode::heading);
  EXPECT_NEAR(end.heading_deg, 180.0, 15.0);
}

// Orders, weather and a day's worth of ticks: any machine has these bits.
TEST(ClassShip, TheSameWorldOnEveryMachine) {
  World world(scene("    ship_class: vlcc\n    course_deg: 200\n    speed_kn: 12\n",
                    "seed: 9\nsea: {state: 5, wind_from_deg: 250, current_set_deg: 10, "
                    "current_kn: 1, depth_m: 28}\n"));
  std::uint64_t sum = 0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 1500 == 300) world.order(0, 50.0 * i, 4.0 + i % 7);
    world.step();
  }
  const ShipState ship = world.state().own_ships.front();
  for (const double value : {ship.position.latitude_deg, ship.position.longitude_deg,
                             ship.heading_deg, ship.speed_mps, ship.con->motion.v}) {
    sum = sum * 0x100000001b3ull ^ std::bit_cast<std::uint64_t>(value);
  }
  EXPECT_EQ(sum, 0x45a143889569d8d7ull) << std::hex << sum;
}

TEST(ClassShip, FeelsTheWindByTheModelThatIsGiven) {
  const auto blown = [](const char* model) {
    World world(scene(std::string("    ship_class: ferry\n    speed_kn: 0\n") + model,
                      "sea: {wind_from_deg: 250, wind_kn: 40}\n"));
    for (int i = 0; i < 3000; ++i) world.step();
    return world.state().own_ships.front().position;
  };
  EXPECT_EQ(blown(""), blown("    wind_model: blendermann\n"));
  EXPECT_NE(blown(""), blown("    wind_model: isherwood\n"));
}

TEST(ClassShip, AScenariosFaultsAreNamed) {
  const std::string head =
      "name: x\nown_ships:\n  - name: Frida\n    position: {lat: 60.5, lon: 4.5}\n    radars: "
      "[{}]\n";
  EXPECT_EQ(refusal(head + "    ship_class: dinghy\n"),
            "6:17: own_ships[0].ship_class: \"dinghy\" is no ship class; allowed: vlcc, tanker, "
            "container, mariner, ferry, coaster, fast_craft, fishing, tug, pilot");
  EXPECT_EQ(refusal(head + "    route: [{lat: 60, lon: 4}]\n"),
            "6:12: own_ships[0].route: given for a ship without a ship_class; allowed: with one of "
            "vlcc, tanker, container, mariner, ferry, coaster, fast_craft, fishing, tug, pilot");
  EXPECT_EQ(refusal(head + "    wind_model: isherwood\n"),
            "6:17: own_ships[0].wind_model: given for a ship without a ship_class; allowed: with "
            "one of vlcc, tanker, container, mariner, ferry, coaster, fast_craft, fishing, tug, "
            "pilot");
  EXPECT_EQ(
      refusal(head + "    ship_class: vlcc\n    wind_model: beaufort\n"),
      "7:17: own_ships[0].wind_model: expected one of blendermann, isherwood, given beaufort");
  EXPECT_EQ(refusal(head + "    ship_class: vlcc\n    speed_kn: 30\n"),
            "7:15: own_ships[0].speed_kn: 30 kn for a vlcc; allowed: up to 18.6 kn");
  EXPECT_EQ(refusal(head + "    ship_class: vlcc\n    turn_time_constant_s: 8\n"),
            "7:27: own_ships[0].turn_time_constant_s: given besides a ship_class, which says how "
            "she answers; allowed: one of the two");
}

}  // namespace
}  // namespace skerry::server
