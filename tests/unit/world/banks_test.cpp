// Banks of a scenario, and what they do to ships.
#include "server/world/waters/banks.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "server/world/bank_effect.hpp"
#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

// On the equator, metres east and north of (0, 5).
std::string place(double east_m, double north_m) {
  return fmt::format("{{lat: {:.9f}, lon: {:.9f}}}", north_m / 110574.276,
                     5.0 + east_m / 111319.491);
}

std::string wall(double east_m, double from_m = -4000.0, double to_m = 15'000.0) {
  return fmt::format("  - {{line: [{}, {}]}}\n", place(east_m, from_m), place(east_m, to_m));
}

// A coaster that goes north at 10 kn in 8 m of water, from (0, 5) on her track.
scenario::Scenario along(const std::string& banks, const char* sea = "{depth_m: 8}") {
  return parse_scenario(
      fmt::format("name: s\nsea: {}\nown_ships:\n  - {{name: F, ship_class: coaster, position: {}, "
                  "speed_kn: 10, route: [{}], radars: [{{}}]}}\n{}{}",
                  sea, place(0, 0), place(0, 14'000), banks.empty() ? "" : "banks:\n", banks),
      "f");
}

BankShape coaster() { return find_ship_class("coaster")->bank_shape(); }

struct Held {
  double rudder_deg = 0.0, heading_deg = 0.0, off_m = 0.0;  // means of ten minutes
};

Held held(const std::string& banks) {
  World world(along(banks));
  Held mean;
  constexpr int kSettle = 6000, kMean = 6000;
  for (int i = 0; i < kSettle + kMean; ++i) {
    world.step();
    if (i < kSettle) continue;
    const ShipState ship = world.state().own_ships.front();
    mean.rudder_deg += ship.con->rudder_deg / kMean;
    mean.heading_deg += std::remainder(ship.heading_deg, 360.0) / kMean;
    mean.off_m += short_way_between({0.0, 5.0}, ship.position).east_m / kMean;
  }
  EXPECT_FALSE(world.state().own_ships.front().aground);
  std::printf("rudder %6.3f deg, heading %6.3f deg, %6.2f m to starboard of her track\n",
              mean.rudder_deg, mean.heading_deg, mean.off_m);
  return mean;
}

TEST(Banks, NearOneSheHoldsHerLineWithHelmTowardsIt) {
  const Held open = held("");
  const Held right = held(wall(20.0)), left = held(wall(-20.0));
  EXPECT_NEAR(open.rudder_deg, 0.0, 0.05);
  EXPECT_GT(right.rudder_deg, 2.0) << "to starboard, towards the bank";
  EXPECT_LT(right.rudder_deg, 20.0);
  EXPECT_LT(right.heading_deg, -0.1) << "her bow points away from it";
  EXPECT_NEAR(left.rudder_deg, -right.rudder_deg, 0.02);
  EXPECT_LT(std::fabs(right.off_m), 6.0);
}

TEST(Banks, OnTheMiddleLineSheNeedsNone) {
  const Held middle = held(wall(20.0) + wall(-20.0));
  EXPECT_NEAR(middle.rudder_deg, 0.0, 0.05);
  EXPECT_NEAR(middle.heading_deg, 0.0, 0.02);
  const Held off = held(wall(26.0) + wall(-40.0)), alone = held(wall(26.0));
  EXPECT_GT(off.rudder_deg, 1.0) << "right of it, some";
  EXPECT_LT(off.rudder_deg, alone.rudder_deg - 0.5) << "the other bank takes some away";
}

TEST(Banks, WithoutHelmSheSheersOff) {
  World world(along(wall(20.0)));
  wire::ConOrder hands;
  hands.set_rudder_deg(0.0);
  world.order(0, hands);
  for (int i = 0; i < 900; ++i) world.step();
  EXPECT_LT(std::remainder(world.state().own_ships.front().heading_deg, 360.0), -5.0);
}

TEST(Banks, PullBySideDistanceAndSum) {
  const Banks right(along(wall(25.0))), both(along(wall(25.0) + wall(-40.0)));
  const BankPull one = wall_pull(coaster(), 25.0, 8.0), other = wall_pull(coaster(), 40.0, 8.0);
  const BankPull north = pull_of(right, coaster(), {0.0, 5.0}, 0.0, 8.0);
  EXPECT_NEAR(north.sway / one.sway, 1.0, 1e-4);
  EXPECT_NEAR(north.yaw / one.yaw, 1.0, 1e-4);
  const BankPull south = pull_of(right, coaster(), {0.0, 5.0}, 180.0, 8.0);
  EXPECT_NEAR(south.sway / one.sway, -1.0, 1e-4);
  EXPECT_NEAR(south.yaw / one.yaw, -1.0, 1e-4);
  const BankPull sum = pull_of(both, coaster(), {0.0, 5.0}, 0.0, 8.0);
  EXPECT_NEAR(sum.sway, one.sway - other.sway, 1e-4 * one.sway);
  EXPECT_NEAR(sum.yaw, one.yaw - other.yaw, 1e-4 * -one.yaw);
  // At 30 deg to it: by the square of the cosine; towards it, nothing.
  EXPECT_NEAR(pull_of(right, coaster(), {0.0, 5.0}, 30.0, 8.0).sway / one.sway, 0.75, 1e-4);
  EXPECT_NEAR(pull_of(right, coaster(), {0.0, 5.0}, 90.0, 8.0).sway / one.sway, 0.0, 1e-9);
  // Two on one side: the stronger.
  const Banks twice(along(wall(25.0) + wall(26.0)));
  EXPECT_NEAR(pull_of(twice, coaster(), {0.0, 5.0}, 0.0, 8.0).sway / one.sway, 1.0, 1e-4);
  EXPECT_FALSE(pull_of(right, coaster(), {0.0, 4.99}, 0.0, 8.0).acts());
  EXPECT_FALSE(pull_of(right, coaster(), {1.0, 5.0}, 0.0, 8.0).acts());
}

// Past the ends and a corner of banks, and over a line, in steps of 0.1 m and on all headings.
TEST(Banks, NothingJumps) {
  const Banks banks(along("  - {line: [" + place(20, -300) + ", " + place(20, 200) + ", " +
                          place(150, 300) + "]}\n" + wall(-30.0, 0.0, 400.0)));
  const double most = wall_pull(coaster(), 0.6 * coaster().beam_m, 8.0).sway;
  double worst = 0.0;
  for (int heading = 0; heading < 360; heading += 15) {
    for (const double east : {-45.0, 0.0, 35.0}) {
      double before = NAN;
      for (int i = -5000; i < 5500; ++i) {
        const GeoPoint at{0.1 * i / 110574.276, 5.0 + east / 111319.491};
        const double now = pull_of(banks, coaster(), at, heading, 8.0).sway;
        ASSERT_TRUE(std::isfinite(now));
        ASSERT_LE(std::fabs(now), most * 1.0001);
        if (i > -5000) worst = std::max(worst, std::fabs(now - before));
        before = now;
      }
    }
  }
  std::printf("worst change in 0.1 m: %.4f of the strongest pull\n", worst / most);
  EXPECT_LT(worst, 0.03 * most);
}

TEST(Banks, AreTheSameAcrossTheDateLine) {
  scenario::Scenario scenario = along("");
  scenario::Bank& bank = *scenario.add_banks();
  for (const double lat : {-0.1, 0.1}) {
    scenario::Position& point = *bank.add_line();
    point.set_lat(lat);
    point.set_lon(lat < 0.0 ? 179.9998 : -179.9998);
  }
  const Banks banks(scenario);
  const auto near = banks.near({0.0, 179.9999}, 100.0);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NEAR(near[0].way.east_m, 1e-4 * 111319.491, 1e-3);
  EXPECT_TRUE(banks.near({0.0, -179.99}, 100.0).empty());
}

TEST(Banks, SheRunsAgroundWhereHerSideTouchesOne) {
  scenario::Scenario scenario = along("");
  scenario::Bank& bank = *scenario.add_banks();
  bank.set_name("the mole");
  for (const double lon : {4.999, 5.001}) {
    scenario::Position& point = *bank.add_line();
    point.set_lat(0.004);
    point.set_lon(lon);
  }
  World world(scenario);
  for (int i = 0; i < 1200; ++i) world.step();
  const WorldState state = world.state();
  ASSERT_EQ(state.log->contacts.size(), 1u);
  EXPECT_EQ(state.log->contacts[0].kind, Contact::Kind::grounding);
  EXPECT_EQ(state.log->contacts[0].why, "the mole");
  const ShipState ship = state.own_ships.front();
  EXPECT_TRUE(ship.aground);
  EXPECT_EQ(ship.speed_mps, 0.0);
  const double bow_m = short_way_between(ship.position, {0.004, 5.0}).north_m - 40.0;
  EXPECT_GT(bow_m, -0.6) << "at most a tick over it";
  EXPECT_LE(bow_m, 0.01);
}

TEST(Banks, TheSameWorldOnEveryMachine) {
  World world(along(wall(24.0) + wall(-60.0), "{depth_m: 7, state: 3, wind_from_deg: 250}"));
  std::uint64_t sum = 0;
  for (int i = 0; i < 6000; ++i) world.step();
  const ShipState ship = world.state().own_ships.front();
  EXPECT_FALSE(ship.aground);
  for (const double value : {ship.position.latitude_deg, ship.position.longitude_deg,
                             ship.heading_deg, ship.speed_mps, ship.con->motion.v}) {
    sum = sum * 0x100000001b3ull ^ std::bit_cast<std::uint64_t>(value);
  }
  EXPECT_EQ(sum, 0x2479df82f225adfcull) << std::hex << sum;
}

// Without banks nothing of them is there, and far from them every bit is as without.
TEST(Banks, CostNothingWhereThereAreNone) {
  EXPECT_EQ(World(along("")).state().environment->banks, nullptr);
  World none(along("")), far(along(wall(300.0)));
  for (int i = 0; i < 3000; ++i) {
    none.step();
    far.step();
  }
  EXPECT_EQ(none.state().own_ships.front().position, far.state().own_ships.front().position);
  EXPECT_EQ(none.state().own_ships.front().heading_deg, far.state().own_ships.front().heading_deg);
}

TEST(Banks, MistakesAreToldTogether) {
  const std::string told = refusal(
      "name: s\nown_ships: [{name: F, position: {lat: 60, lon: 5}, radars: [{}]}]\nbanks:\n"
      "  - {line: [{lat: 60, lon: 5}]}\n"
      "  - {line: [{lat: 60, lon: 5}, {lat: 60, lon: 5}, {lat: 61, lon: 5}]}\n"
      "  - {name: W}\n"
      "  - {line: [{lat: 60, lon: 5}, {lat: 99, lon: 5}]}\n");
  EXPECT_EQ(
      told,
      "4:12: banks[0].line: 1 points; allowed: 2 to 200\n"
      "test.yaml:5:32: banks[1].line[1]: 0.0 m from the point before it; allowed: 1 to 20000 m\n"
      "test.yaml:5:51: banks[1].line[2]: 111420.7 m from the point before it; allowed: 1 to "
      "20000 m\n"
      "test.yaml:6:5: banks[2].line: 0 points; allowed: 2 to 200\n"
      "test.yaml:7:38: banks[3].line[1].lat: 99 is out of range; allowed: -90 to 90 deg\n"
      "test.yaml: 5 errors");
}

}  // namespace
}  // namespace skerry::server
