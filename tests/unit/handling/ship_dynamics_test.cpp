#include "server/world/handling/ship_dynamics.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace skerry::server {
namespace {

// As server/world has them.
constexpr int kSubsteps = 2;

struct Place {
  double north_m = 0.0, east_m = 0.0;
  DynamicState state;
};

// Orders change every minute: a wandering way of `seconds`, from the seed.
Place wandered(const ShipClass& ship, double seconds, int substeps, std::uint64_t seed,
               double wind_mps = 0.0) {
  Place at;
  at.state = under_way(ship, 30.0, 0.8 * ship.service_speed_mps);
  ActuatorOrders orders{.shaft_rps = at.state.shaft_rps};
  Surroundings around{.wind_from_deg = 250.0, .wind_mps = wind_mps, .depth_m = 60.0};
  std::uint64_t chance = seed;
  const double step = 0.1 / substeps;
  const auto ticks = static_cast<long>(seconds * 10.0 + 0.5);
  for (long tick = 0; tick < ticks; ++tick) {
    around.time_s = 0.1 * static_cast<double>(tick);
    if (tick % 600 == 0) {
      chance = chance * 6364136223846793005ull + 1442695040888963407ull;
      orders.rudder_deg = static_cast<double>(chance >> 40 & 0x3f) - 32.0;
      orders.bow = static_cast<double>(chance >> 50 & 0xf) / 7.5 - 1.0;
    }
    for (int i = 0; i < substeps; ++i) {
      const WayMade way = advance(ship, orders, around, step, at.state);
      at.north_m += way.north_m;
      at.east_m += way.east_m;
    }
  }
  return at;
}

TEST(ShipDynamics, TwoStepsATickAreAsGoodAsTwenty) {
  for (const ShipClass& ship : ship_classes()) {
    const Place coarse = wandered(ship, 1200.0, kSubsteps, 5);
    const Place fine = wandered(ship, 1200.0, 10 * kSubsteps, 5);
    const double off = std::hypot(coarse.north_m - fine.north_m, coarse.east_m - fine.east_m);
    std::printf("%-11s after 20 minutes of turns: %.2e m\n", ship.key.data(), off);
    EXPECT_LT(off, 0.05) << ship.key;
  }
}

// Orders that no pilot corrects, for an hour; the sum of the bits must be that of every machine.
TEST(ShipDynamics, TheSameBitsOnEveryMachine) {
  std::uint64_t sum = 0;
  for (const ShipClass& ship : ship_classes()) {
    const Place at = wandered(ship, 1800.0, 1, 11, 12.0);
    for (const double value : {at.north_m, at.east_m, at.state.heading_rad, at.state.motion.u,
                               at.state.motion.v, at.state.motion.r, at.state.motion.roll}) {
      sum = sum * 0x100000001b3ull ^ std::bit_cast<std::uint64_t>(value);
    }
  }
  EXPECT_EQ(sum, 0x5e30553f8f31db4full) << std::hex << sum;
}

TEST(ShipDynamics, ACurrentMovesTheWaterAndNothingElse) {
  const ShipClass& ship = *find_ship_class("coaster");
  const Surroundings still, stream{.current_set_deg = 90.0, .current_mps = 1.5};
  DynamicState a = under_way(ship, 0.0, 5.0), b = a;
  const ActuatorOrders orders{.rudder_deg = 15.0, .shaft_rps = a.shaft_rps};
  double north_a = 0, east_a = 0, north_b = 0, east_b = 0;
  for (int tick = 0; tick < 6000; ++tick) {
    const WayMade wa = advance(ship, orders, still, 0.1, a);
    const WayMade wb = advance(ship, orders, stream, 0.1, b);
    north_a += wa.north_m;
    east_a += wa.east_m;
    north_b += wb.north_m;
    east_b += wb.east_m;
  }
  EXPECT_EQ(a.motion.u, b.motion.u);
  EXPECT_EQ(a.heading_rad, b.heading_rad);
  EXPECT_NEAR(north_b, north_a, 1e-6);
  EXPECT_NEAR(east_b - east_a, 1.5 * 600.0, 1e-6);
}

TEST(ShipDynamics, AStoppedShipDriftsDownwind) {
  for (const ShipClass& ship : ship_classes()) {
    DynamicState state;
    const Surroundings wind{.wind_from_deg = 270.0, .wind_mps = 15.0};
    double east = 0.0;
    for (int tick = 0; tick < 18000; ++tick) {
      const WayMade way = advance(ship, {}, wind, 0.1, state);
      if (tick >= 12000) east += way.east_m;
    }
    const double share = east / 600.0 / 15.0;
    std::printf("%-11s drifts at %.1f %% of the wind\n", ship.key.data(), 100.0 * share);
    EXPECT_GT(share, 0.005) << ship.key;
    EXPECT_LT(share, 0.2) << ship.key;
  }
}

TEST(ShipDynamics, EveryClassStartsStopsAndGoesAstern) {
  for (const ShipClass& ship : ship_classes()) {
    DynamicState state;
    ActuatorOrders orders{.shaft_rps = ship.ahead_rps};
    for (int tick = 0; tick < 36000; ++tick) advance(ship, orders, {}, 0.1, state);
    // Those that do not keep their course by themselves have begun to turn, and are slower.
    EXPECT_GT(state.motion.u, 0.5 * ship.service_speed_mps) << ship.key;
    EXPECT_LT(state.motion.u, 1.02 * ship.service_speed_mps) << ship.key;
    orders.shaft_rps = -ship.astern_rps;
    for (int tick = 0; tick < 36000; ++tick) advance(ship, orders, {}, 0.1, state);
    std::printf("%-11s astern %.2f m/s\n", ship.key.data(), state.motion.u);
    EXPECT_LT(state.motion.u, -0.1 * ship.service_speed_mps) << ship.key;
    EXPECT_GT(state.motion.u, -0.95 * ship.service_speed_mps) << ship.key;
    orders.shaft_rps = 0.0;
    for (int tick = 0; tick < 36000; ++tick) advance(ship, orders, {}, 0.1, state);
    EXPECT_LT(std::fabs(state.motion.u), 0.15 * ship.service_speed_mps) << ship.key;
  }
}

TEST(ShipDynamics, NothingMakesHerMotionWild) {
  const double speeds[] = {-6.0, -0.5, 0.0, 0.5, 14.0};
  for (const ShipClass& ship : ship_classes()) {
    for (const double u : speeds) {
      for (const double v : {-4.0, 0.0, 3.0}) {
        for (const double rudder : {-35.0, 0.0, 35.0}) {
          DynamicState state;
          state.motion = {.u = u, .v = v, .r = 0.05};
          const ActuatorOrders orders{.rudder_deg = rudder,
                                      .shaft_rps = u > 0 ? -ship.astern_rps : ship.ahead_rps,
                                      .bow = 1.0,
                                      .stern = -1.0};
          const Surroundings storm{.wind_from_deg = 30.0,
                                   .wind_mps = 35.0,
                                   .depth_m = 1.01 * ship.hull->draught_m(),
                                   .wave_height_m = 12.0,
                                   .waves_from_deg = 100.0};
          for (int tick = 0; tick < 3000; ++tick) {
            advance(ship, orders, storm, 0.1, state);
            const BodyMotion& m = state.motion;
            ASSERT_TRUE(std::isfinite(m.u) && std::isfinite(m.v) && std::isfinite(m.r)) << ship.key;
            ASSERT_LT(std::fabs(m.u), 30.0) << ship.key << " at " << tick;
            ASSERT_LT(std::fabs(m.v), 15.0) << ship.key << " at " << tick;
            ASSERT_LT(std::fabs(m.r), 1.5) << ship.key << " at " << tick;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace skerry::server
