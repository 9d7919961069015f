#include "server/world/handling/bank_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "server/world/handling/ship_dynamics.hpp"

namespace skerry::server {
namespace {

constexpr double kPi = std::numbers::pi;

// The integrals of bank_load.hpp in many small steps and with many images, by libm.
struct SlowPull {
  double suction = 0.0, stern = 0.0;  // N for 1 m/s
};

double slope_of_area(const BankShape& s, double x_m) {
  const double prismatic = std::max(s.block, 2.0 / 3.0), parallel = 3.0 * prismatic - 2.0;
  const double place = 2.0 * x_m / s.length_m;
  const double beyond = (std::abs(place) - parallel) / (1.0 - parallel);
  if (beyond <= 0.0) return 0.0;
  const double most = s.block / prismatic * s.beam_m * s.draught_m;
  return -std::copysign(4.0 * most * beyond / ((1.0 - parallel) * s.length_m), place);
}

double slow_across(double along, double distance, double depth) {
  double sum = 0.0;
  for (int k = -300; k <= 300; ++k) {
    sum += std::pow(along * along + 4.0 * distance * distance + 4.0 * k * k * depth * depth, -1.5);
  }
  return 2.0 * distance * sum;
}

SlowPull slow_pull(const BankShape& s, double distance, double depth) {
  constexpr int kSteps = 240;
  const double step = s.length_m / kSteps;
  std::vector<double> across(kSteps), slopes(kSteps);
  SlowPull pull;
  for (int i = 0; i < kSteps; ++i) {
    across[static_cast<std::size_t>(i)] = slow_across(i * step, distance, depth);
    slopes[static_cast<std::size_t>(i)] = slope_of_area(s, (i + 0.5) * step - 0.5 * s.length_m);
    pull.stern +=
        slopes[static_cast<std::size_t>(i)] * step * slow_across((i + 0.5) * step, distance, depth);
  }
  for (std::size_t i = 0; i < kSteps; ++i) {
    for (std::size_t j = 0; j < kSteps; ++j) {
      pull.suction += slopes[i] * slopes[j] * step * step * across[i > j ? i - j : j - i];
    }
  }
  pull.suction *= kSeaWater_kg_m3 / (2.0 * kPi);
  const double plate = -4.0 * kSeaWater_kg_m3 * depth * depth / kPi *
                       std::log(std::cos(kPi * s.draught_m / 2 / depth));
  pull.stern *= plate / (2.0 * kPi);
  return pull;
}

TEST(BankLoad, IsThatOfTheIntegrals) {
  double worst = 0.0;
  for (const ShipClass& ship : ship_classes()) {
    const BankShape s = ship.bank_shape();
    for (const double beams : {0.6, 0.8, 1.3, 2.5, 5.9}) {
      for (const double draughts : {1.1, 1.5, 3.0, 20.0}) {
        const BankPull fast = wall_pull(s, beams * s.beam_m, draughts * s.draught_m);
        const SlowPull slow = slow_pull(s, beams * s.beam_m, draughts * s.draught_m);
        worst = std::max({worst, std::abs(fast.sway / (slow.suction + slow.stern) - 1.0),
                          std::abs(fast.yaw / (-0.5 * s.length_m * slow.stern) - 1.0)});
      }
    }
  }
  std::printf("worst: %.2e\n", worst);
  EXPECT_LT(worst, 5e-3);
}

// Lagally's theorem against Bernoulli: the sources drive water along the wall, and what is missing
// of the pressure there is what draws her.  Terms of the first order cancel over the whole wall.
TEST(BankLoad, IsThePressureOnTheWall) {
  const BankShape s{100.0, 16.0, 6.0, 0.7};
  constexpr int kSources = 40, kImages = 12;
  for (const double depth : {9.0, 1e4}) {
    const double distance = 20.0, bottom = std::min(depth, 400.0);
    const int images = depth < 100.0 ? kImages : 0;
    double force = 0.0;
    for (double x = -400.0; x < 400.0; x += 4.0) {
      // Down to the bottom, or far: steps that grow.
      double z = 0.0;
      for (double dz = 0.9; z < bottom - 1e-9; z += dz) {
        if (images == 0) dz = 1.0 + 0.1 * z;
        const double middle = z + 0.5 * dz;
        double along = 0.0, down = 0.0;
        for (int i = 0; i < kSources; ++i) {
          const double at = (i + 0.5) * s.length_m / kSources - 0.5 * s.length_m;
          // Twice her sections, and twice for the image in the wall.
          const double strength = -4.0 * slope_of_area(s, at) * s.length_m / kSources / (4.0 * kPi);
          for (int k = -images; k <= images; ++k) {
            const double dx = x + 2.0 - at, dy = middle - 2.0 * k * depth;
            const double r = std::sqrt(dx * dx + dy * dy + distance * distance);
            along += strength * dx / (r * r * r);
            down += strength * dy / (r * r * r);
          }
        }
        force += 0.5 * kSeaWater_kg_m3 * (along * along + down * down) * 4.0 * dz;
      }
    }
    const BankPull pull = wall_pull(s, distance, depth);
    const double lagally = pull.sway + pull.yaw / (0.5 * s.length_m);
    std::printf("depth %6.0f m: %.0f N by the wall, %.0f N by her sources\n", depth, force,
                lagally);
    EXPECT_NEAR(force, lagally, 0.03 * lagally) << depth;
  }
}

// R. T. Jones' wing in deep water, and the growth of a plate's added mass above a bottom.
TEST(BankLoad, HerSternShedsWhatAPlateDoes) {
  const BankShape s{100.0, 16.0, 6.0, 0.7};
  const auto stern_flow = [&](double depth) {
    double flow = 0.0;
    for (double x = 0.25; x < s.length_m; x += 0.5) {
      flow += 0.5 * slope_of_area(s, x - 0.5 * s.length_m) * slow_across(x, 30.0, depth);
    }
    return flow / (2.0 * kPi);
  };
  const auto mass = [&](double depth) {
    return -wall_pull(s, 30.0, depth).yaw / (0.5 * s.length_m) / stern_flow(depth);
  };
  const double deep = 0.5 * kSeaWater_kg_m3 * kPi * s.draught_m * s.draught_m;
  EXPECT_NEAR(mass(120.0) / deep, 1.0, 5e-3);
  EXPECT_NEAR(mass(7.2) / deep, 1.578, 8e-3) << "ln cos(75 deg)";
}

TEST(BankLoad, GrowsNearTheBankAndInShallowWaterAndEndsFarOff) {
  for (const ShipClass& ship : ship_classes()) {
    const BankShape s = ship.bank_shape();
    BankPull before = wall_pull(s, 0.6 * s.beam_m, 1.5 * s.draught_m);
    for (int tenths = 7; tenths < 80; ++tenths) {
      const double beams = 0.1 * tenths;
      const BankPull now = wall_pull(s, beams * s.beam_m, 1.5 * s.draught_m);
      const BankPull deep = wall_pull(s, beams * s.beam_m, 3.0 * s.draught_m);
      EXPECT_GT(now.sway, 0.0);
      EXPECT_LT(now.yaw, 0.0);
      EXPECT_LT(now.sway, before.sway) << ship.key;
      EXPECT_GT(now.yaw, before.yaw) << ship.key;
      EXPECT_LT(deep.sway, now.sway) << ship.key;
      EXPECT_GT(deep.yaw, now.yaw) << ship.key;
      before = now;
    }
    EXPECT_FALSE(wall_pull(s, 8.0 * s.beam_m, 1.5 * s.draught_m).acts());
    EXPECT_FALSE(wall_pull(s, 0.0, 1.5 * s.draught_m).acts());
    const double unit = 0.5 * kSeaWater_kg_m3 * s.length_m * s.draught_m;
    const BankPull near = wall_pull(s, s.beam_m, 1.2 * s.draught_m);
    std::printf("%-11s a beam off, 1.2 draughts deep: Y' %.4f N' %.4f\n", ship.key.data(),
                near.sway / unit, near.yaw / (unit * s.length_m));
  }
}

TEST(BankLoad, IsBySquareOfTheWayAndTurnsHerTheOtherWayAstern) {
  const BankPull pull{.sway = 100.0, .yaw = -3000.0};
  EXPECT_EQ(bank_load(pull, 3.0).y, 900.0);
  EXPECT_EQ(bank_load(pull, 3.0).n, -27000.0);
  EXPECT_EQ(bank_load(pull, -2.0).y, 400.0);
  EXPECT_EQ(bank_load(pull, -2.0).n, 12000.0);
  EXPECT_EQ(bank_load(pull, 0.0).y, 0.0);
  EXPECT_EQ(bank_load(pull, 3.0).x, 0.0);
}

// Held against a wall a tenth of a beam off, in hardly any water, for as long as she likes.
TEST(BankLoad, DoesNotMakeHerMotionWild) {
  for (const ShipClass& ship : ship_classes()) {
    const BankShape s = ship.bank_shape();
    Surroundings around{.depth_m = 1.01 * s.draught_m};
    around.banks = wall_pull(s, 0.6 * s.beam_m, around.depth_m);
    for (const double share : {-0.5, 0.0, 1.2}) {
      for (const double v : {-4.0, 0.0, 4.0}) {
        DynamicState state = under_way(ship, 0.0, share * ship.service_speed_mps);
        state.motion.v = v;
        const ActuatorOrders orders{.rudder_deg = -35.0, .shaft_rps = ship.ahead_rps};
        for (int tick = 0; tick < 3000; ++tick) {
          advance(ship, orders, around, 0.1, state);
          const BodyMotion& m = state.motion;
          ASSERT_TRUE(std::isfinite(m.u) && std::isfinite(m.v) && std::isfinite(m.r)) << ship.key;
          ASSERT_LT(std::fabs(m.u), 30.0) << ship.key;
          ASSERT_LT(std::fabs(m.v), 15.0) << ship.key;
          ASSERT_LT(std::fabs(m.r), 1.5) << ship.key;
        }
      }
    }
  }
}

// In a channel the walls mirror one another's images: those at 2 (a + n W) on the one side and
// 2 (b + n W) on the other are left over, W wide.  Adding two single walls leaves out n >= 1.
TEST(BankLoad, TwoWallsAddUpButForTheirMirrors) {
  double worst = 0.0;
  for (const char* key : {"vlcc", "container", "coaster"}) {
    const BankShape s = find_ship_class(key)->bank_shape();
    const double wide = 5.0 * s.beam_m, depth = 1.5 * s.draught_m;
    for (const double beams : {0.8, 1.2, 1.8}) {
      const double near = beams * s.beam_m, far = wide - near;
      const auto apart = [&](double more) {
        const SlowPull a = slow_pull(s, near + more, depth), b = slow_pull(s, far + more, depth);
        return SlowPull{a.suction - b.suction, a.stern - b.stern};
      };
      const SlowPull added = apart(0.0);
      SlowPull whole = added;
      for (int n = 1; n <= 3; ++n) {
        const SlowPull more = apart(n * wide);
        whole.suction += more.suction;
        whole.stern += more.stern;
      }
      worst = std::max({worst, 1.0 - added.stern / whole.stern,
                        1.0 - (added.suction + added.stern) / (whole.suction + whole.stern)});
    }
  }
  std::printf("in a channel of five beams too little by up to %.1f %%\n", 100.0 * worst);
  EXPECT_LT(worst, 0.06);
  EXPECT_GT(worst, 0.0);
}

// The helm and the drift that hold her on a line along a wall at half her speed.  For scale: by the
// abstract of Yasukawa, Ocean Engineering 188 (2019), a car carrier by a sloped bank needs all of
// 35 deg at 0.27 lengths from it in 1.2 draughts of water.
TEST(BankLoad, IsHeldByAHelmThatShipsHave) {
  for (const ShipClass& ship : ship_classes()) {
    const double length = ship.hull->length_m(), u = 0.5 * ship.service_speed_mps;
    double before_deg = 90.0;
    for (const double draughts : {1.2, 1.5, 2.0}) {
      const double depth = draughts * ship.hull->draught_m();
      const Loads pull = bank_load(wall_pull(ship.bank_shape(), 0.27 * length, depth), u);
      const double shaft = shaft_for(*ship.hull, u);
      const auto rates = [&](double v, double rudder) {
        return ship.hull->change({.u = u, .v = v}, {rudder, shaft}, depth, pull);
      };
      double v = 0.0, rudder = 0.0;
      for (int i = 0; i < 100; ++i) {
        constexpr double kSmall = 1e-4;
        const BodyChange at = rates(v, rudder);
        const BodyChange by_v = rates(v + kSmall, rudder), by_rudder = rates(v, rudder + kSmall);
        const double a = (by_v.v - at.v) / kSmall, b = (by_rudder.v - at.v) / kSmall;
        const double c = (by_v.r - at.r) / kSmall, d = (by_rudder.r - at.r) / kSmall;
        v -= 0.5 * (at.v * d - at.r * b) / (a * d - b * c);
        rudder -= 0.5 * (a * at.r - c * at.v) / (a * d - b * c);
      }
      const double helm_deg = rudder * 180.0 / kPi;
      std::printf("%-11s %.1f draughts: helm %5.1f deg to the bank, drift %.2f deg\n",
                  ship.key.data(), draughts, helm_deg, std::atan2(v, u) * 180.0 / kPi);
      EXPECT_GT(helm_deg, 1.0) << ship.key;
      EXPECT_LT(helm_deg, 35.0) << ship.key;
      EXPECT_LT(helm_deg, before_deg) << ship.key << ": deeper, less";
      EXPECT_GT(v, 0.0) << ship.key << ": her bow away from it";
      before_deg = helm_deg;
    }
  }
}

// Without a pull, a ship's bits are those of a ship that knows no banks (ShipDynamics has the
// hash); with one she sheers: stern in, bow out.
TEST(BankLoad, MakesAShipSheerOffWithoutHelm) {
  const ShipClass& ship = *find_ship_class("coaster");
  DynamicState state = under_way(ship, 0.0, 5.0);
  Surroundings around{.depth_m = 8.0};
  around.banks = wall_pull(ship.bank_shape(), 16.0, around.depth_m);
  const ActuatorOrders orders{.shaft_rps = state.shaft_rps};
  for (int tick = 0; tick < 300; ++tick) advance(ship, orders, around, 0.1, state);
  EXPECT_LT(state.heading_rad, -0.03) << "to port, for the bank is to starboard";
}

}  // namespace
}  // namespace skerry::server
