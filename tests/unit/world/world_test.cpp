#include "server/world/world.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

// All numbers of a state as bits: equal only if every last bit is.
std::string bits_of(const WorldState& state) {
  std::string bits;
  const auto add = [&](const auto& value) {
    bits.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(state.time);
  for (const auto* ships : {&state.own_ships, &state.targets}) {
    for (const ShipState& ship : *ships) {
      bits += ship.name;
      for (const double value :
           {ship.position.latitude_deg, ship.position.longitude_deg, ship.heading_deg,
            ship.course_over_ground_deg, ship.speed_mps, ship.rate_of_turn_deg_s,
            ship.ordered_course_deg, ship.ordered_speed_mps, ship.length_m, ship.beam_m,
            ship.height_m}) {
        add(value);
      }
    }
  }
  return bits;
}

std::string run(World world, int first_order_tick) {
  std::string bits;
  for (int k = 0; k < 3000; ++k) {
    if (k == first_order_tick) world.order(0, 270.0, 6.5);
    if (k == 900) world.order(1, std::nullopt, 20.0);
    if (k == 901) world.order(1, 12.5, std::nullopt);
    bits += bits_of(world.state());
    world.step();
  }
  return bits;
}

TEST(World, IsTheSameBitForBitEachTime) {
  const std::string first = run(World(default_scenario()), 500);
  EXPECT_TRUE(first == run(World(default_scenario()), 500));
  EXPECT_FALSE(first == run(World(default_scenario()), 501)) << "the test would see a difference";
}

TEST(World, StartsAsTheScenarioSays) {
  const World world(default_scenario());
  const WorldState state = world.state();
  EXPECT_EQ(state.time, ScenarioTime{});
  ASSERT_EQ(state.own_ships.size(), 2u);
  EXPECT_EQ(state.targets.size(), 12u);
  EXPECT_EQ(state.own_ships[0].name, "Frida");
  EXPECT_EQ(state.own_ships[0].heading_deg, 159.0);
  EXPECT_DOUBLE_EQ(state.own_ships[0].speed_mps, 10.0 * 1852.0 / 3600.0);
  EXPECT_EQ(state.own_ships[0].length_m, 90.0);
}

TEST(World, KeepsTimeByTicks) {
  World world(default_scenario());
  for (int i = 0; i < 37; ++i) world.step();
  EXPECT_EQ(world.tick(), 37u);
  EXPECT_EQ(world.state().time.time_since_epoch(), std::chrono::milliseconds(3700));
}

TEST(World, AnOrderTakesEffectWithTheNextTick) {
  World world(default_scenario());
  const std::string before = bits_of(world.state());
  world.order(0, 200.0, 5.0);
  EXPECT_TRUE(bits_of(world.state()) == before);
  world.step();
  EXPECT_EQ(world.state().own_ships[0].ordered_course_deg, 200.0);
  EXPECT_DOUBLE_EQ(world.state().own_ships[0].ordered_speed_mps, 5.0 * 1852.0 / 3600.0);
  EXPECT_GT(world.state().own_ships[0].rate_of_turn_deg_s, 0.0);
  EXPECT_LT(world.state().own_ships[0].speed_mps, 10.0 * 1852.0 / 3600.0);
}

TEST(World, WhatIsNotOrderedStays) {
  World world(default_scenario());
  world.order(0, 200.0, std::nullopt);
  world.order(0, std::nullopt, 5.0);
  world.step();
  EXPECT_EQ(world.state().own_ships[0].ordered_course_deg, 200.0);
  EXPECT_NEAR(world.state().own_ships[0].ordered_speed_mps, 2.572, 1e-3);
  EXPECT_EQ(world.state().own_ships[1].ordered_course_deg, 347.4) << "the other ship";
}

TEST(World, RefusesImpossibleOrdersWhole) {
  World world(default_scenario());
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(world.order(2, 90.0, 5.0), std::invalid_argument);
  EXPECT_THROW(world.order(0, kNaN, 5.0), std::invalid_argument);
  EXPECT_THROW(world.order(0, kInf, 5.0), std::invalid_argument);
  EXPECT_THROW(world.order(0, 90.0, kNaN), std::invalid_argument);
  EXPECT_THROW(world.order(0, 90.0, 60.1), std::invalid_argument);
  EXPECT_THROW(world.order(0, 90.0, -10.1), std::invalid_argument);
  world.step();
  EXPECT_EQ(world.state().own_ships[0].ordered_course_deg, 159.0);
  try {
    world.order(0, 90.0, 61.0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "speed: 61 kn is out of range; allowed: -10 to 60 kn");
  }
}

World world_with_sea(const std::string& sea) {
  return World(
      parse_scenario("name: Tide\nown_ships:\n"
                     "  - {name: Tern, position: {lat: 60, lon: 5}, radars: [{}]}\n" +
                         sea,
                     "tide.yaml"));
}

// M2 has a period of 12.4206 h: 447 141.6 ticks.
TEST(World, TheTideFallsFromHighWaterByItsRangeInHalfAPeriod) {
  World world = world_with_sea("sea: {tide_range_m: 4, wave_height_m: 1.5, high_water_h: 1}");
  const auto run_to_hour = [&](double hour) {
    while (world.tick() < static_cast<std::uint64_t>(hour * 36000.0)) world.step();
    return world.state().water_level_m;
  };
  EXPECT_NEAR(run_to_hour(1.0), 0.0, 1e-6);
  EXPECT_NEAR(run_to_hour(1.0 + 12.4206 / 4.0), -2.0, 1e-3);
  EXPECT_NEAR(run_to_hour(1.0 + 12.4206 / 2.0), -4.0, 1e-6);
  EXPECT_DOUBLE_EQ(world.state().environment->wave_height_m, 1.5);
}

TEST(World, ASeaOfWhichNothingIsSaidIsStillAtTheChartedCoastline) {
  World world = world_with_sea("");
  world.step();
  EXPECT_EQ(world.state().water_level_m, 0.0);
  EXPECT_EQ(world.state().environment->wave_height_m, 0.0);
}

}  // namespace
}  // namespace skerry::server
