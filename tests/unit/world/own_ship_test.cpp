#include "server/world/own_ship.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Rhumb.hpp>
#include <chrono>
#include <cstdio>
#include <random>

#include "server/world/dead_reckoning.hpp"
#include "server/world/ship_units.hpp"
#include "tests/unit/world/geodesy.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTick = 100ms;
const Environment kCalm;

scenario::OwnShip model(double course_deg = 0.0, double speed_kn = 12.0) {
  scenario::OwnShip ship;
  ship.set_name("Frida");
  ship.mutable_position()->set_lat(60.4);
  ship.mutable_position()->set_lon(5.0);
  ship.set_course_deg(course_deg);
  ship.set_speed_kn(speed_kn);
  ship.set_speed_time_constant_s(60);
  ship.set_turn_time_constant_s(8);
  ship.set_max_rate_of_turn_deg_min(60);
  return ship;
}

void step(OwnShip& ship, int ticks) {
  for (int i = 0; i < ticks; ++i) ship.step(kCalm);
}

TEST(OwnShip, KeepsItsCourseAndSpeedWithoutOrders) {
  OwnShip ship(model(162.6), kCalm, kTick, 0);
  step(ship, 36'000);
  const ShipState state = ship.state();
  EXPECT_EQ(state.heading_deg, 162.6);
  EXPECT_EQ(state.course_over_ground_deg, 162.6);
  EXPECT_EQ(state.speed_mps, knots_in_mps(12.0));
  EXPECT_EQ(state.rate_of_turn_deg_s, 0.0);
  GeoPoint rhumb;
  GeographicLib::Rhumb::WGS84().Direct(60.4, 5.0, 162.6, 12.0 * 1852.0, rhumb.latitude_deg,
                                       rhumb.longitude_deg);
  std::printf("an hour on a steady course: %.2e m off the rhumb line\n",
              metres_between(state.position, rhumb));
  EXPECT_LT(metres_between(state.position, rhumb), 1e-3);
}

// v(t) = v1 + (v0 - v1) e^(-t/T), way = v1 t + (v0 - v1) T (1 - e^(-t/T)); the state gives the mean
// of v over the coming tick.
TEST(OwnShip, ApproachesTheOrderedSpeedExponentially) {
  constexpr double v0 = knots_in_mps(12.0), v1 = knots_in_mps(-4.0), kT = 60.0;
  OwnShip ship(model(0.0), kCalm, kTick, 0);
  ship.order_speed(v1);
  EXPECT_EQ(ship.state().speed_mps, v0) << "the order waits for the next tick";
  ship.step(kCalm);
  const GeoPoint start = ship.state().position;
  const auto way = [](double t) { return v1 * t + (v0 - v1) * kT * (1 - std::exp(-t / kT)); };
  double worst_speed = 0.0, worst_way = 0.0;
  for (int k = 0; k < 6000; ++k, ship.step(kCalm)) {
    const double t = k * 0.1;
    const ShipState state = ship.state();
    worst_speed = std::max(worst_speed, std::fabs(state.speed_mps - (way(t + 0.1) - way(t)) / 0.1));
    GeoPoint expected;
    GeographicLib::Rhumb::WGS84().Direct(start.latitude_deg, start.longitude_deg, 0.0, way(t),
                                         expected.latitude_deg, expected.longitude_deg);
    worst_way = std::max(worst_way, metres_between(state.position, expected));
  }
  std::printf("speed response: worst %.2e m/s, way %.2e m\n", worst_speed, worst_way);
  EXPECT_LT(worst_speed, 1e-9 /* settled */ + 1e-10 /* differences of way */);
  EXPECT_LT(worst_way, 1e-4);
  step(ship, 10'000);
  EXPECT_EQ(ship.state().speed_mps, v1) << "settles exactly";
}

// With the commanded rate at its limit, r(t) = R (1 - e^(-t/T)) and the heading its integral.
TEST(OwnShip, ApproachesTheCommandedRateOfTurnExponentially) {
  constexpr double kRate = 1.0, kT = 8.0;
  OwnShip ship(model(0.0), kCalm, kTick, 0);
  ship.order_course(170.0);
  ship.step(kCalm);
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k, ship.step(kCalm)) {  // 100 s: 92 deg, 78 left: still at the limit
    const double t = k * 0.1;
    worst = std::max(
        worst, std::fabs(ship.state().heading_deg - kRate * (t - kT * (1 - std::exp(-t / kT)))));
  }
  std::printf("turn at the limit: heading worst %.2e deg\n", worst);
  EXPECT_LT(worst, 1e-9);
}

struct Turn {
  double overshoot_deg = 0.0, seconds = 0.0;
};
Turn turn_to(double time_constant_s, double max_rate_deg_min, double from, double to) {
  scenario::OwnShip ship_model = model(from, 0.0);
  ship_model.set_turn_time_constant_s(time_constant_s);
  ship_model.set_max_rate_of_turn_deg_min(max_rate_deg_min);
  OwnShip ship(ship_model, kCalm, kTick, 0);
  ship.order_course(to);
  const double turn = std::remainder(to - from, 360.0);
  Turn result;
  double made = 0.0, before = from;
  for (int k = 0; k < 700'000; ++k) {
    ship.step(kCalm);
    const double heading = ship.state().heading_deg;
    made += std::remainder(heading - before, 360.0);
    before = heading;
    result.overshoot_deg = std::max(result.overshoot_deg, (made - turn) * (turn < 0 ? -1 : 1));
    if (heading == to && ship.state().rate_of_turn_deg_s == 0.0) {
      result.seconds = (k + 1) * 0.1;
      return result;
    }
  }
  ADD_FAILURE() << "never settled: T " << time_constant_s << " limit " << max_rate_deg_min;
  return result;
}

TEST(OwnShip, TurnsTheShorterWayWithoutOvershoot) {
  double worst = 0.0;
  for (const double time_constant : {0.1, 0.5, 2.0, 8.0, 60.0, 600.0}) {
    for (const double limit : {1.0, 60.0, 720.0}) {
      for (const auto& [from, to] : {std::pair{0.0, 90.0},
                                     {350.0, 20.0},
                                     {10.0, 340.0},
                                     {90.0, 269.0},
                                     {200.0, 200.5},
                                     {5.0, 4.0}}) {
        worst = std::max(worst, turn_to(time_constant, limit, from, to).overshoot_deg);
      }
    }
  }
  std::printf("worst overshoot of a turn from a steady course: %.2e deg\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(OwnShip, TurnsToStarboardToTheOppositeCourse) {
  for (const double from : {0.0, 90.0, 180.0, 270.0}) {
    OwnShip ship(model(from), kCalm, kTick, 0);
    ship.order_course(from + 180.0);
    step(ship, 20);
    EXPECT_GT(ship.state().rate_of_turn_deg_s, 0.0) << from;
  }
}

// The commanded rate set anew every millisecond instead of every tick, with K to match.
TEST(OwnShip, TurnsAsInFineTicks) {
  const auto path_end = [](Duration tick, int ticks) {
    OwnShip ship(model(20.0, 24.0), kCalm, tick, 0);
    ship.order_course(140.0);
    ship.step(kCalm);
    const GeoPoint start = ship.state().position;
    step(ship, ticks);
    return std::pair{start, ship.state()};
  };
  const auto [coarse_start, coarse] = path_end(100ms, 6000);
  const auto [fine_start, fine] = path_end(1ms, 600'000);
  const double apart = std::fabs(metres_between(coarse_start, coarse.position) -
                                 metres_between(fine_start, fine.position));
  std::printf("a turn in ticks of 100 ms and of 1 ms: ends %.3f m apart\n", apart);
  EXPECT_LT(apart, 0.2);
  EXPECT_EQ(coarse.heading_deg, 140.0);
}

TEST(OwnShip, NeverJumpsBetweenTicks) {
  OwnShip ship(model(0.0), kCalm, kTick, 0);
  std::mt19937 random(3);
  for (int k = 0; k < 20'000; ++k) {
    if (k % 97 == 0) ship.order_course(static_cast<double>(random() % 360));
    if (k % 131 == 0) ship.order_speed(knots_in_mps(static_cast<double>(random() % 70) - 10.0));
    const ShipPlace reckoned = position_at(ship.state(), kTick);
    ship.step(kCalm);
    ASSERT_EQ(ship.state().position, reckoned.position);
    ASSERT_NEAR(std::remainder(ship.state().heading_deg - reckoned.heading_deg, 360.0), 0.0, 1e-9);
  }
}

TEST(OwnShip, SailsOverThePoleAndAcrossTheAntimeridian) {
  scenario::OwnShip polar = model(0.0, 30.0);
  polar.mutable_position()->set_lat(89.99);
  OwnShip ship(polar, kCalm, kTick, 0);
  step(ship, 1440);  // 1117 m to the pole, 2222 m made
  EXPECT_EQ(ship.state().heading_deg, 180.0);
  EXPECT_EQ(ship.state().ordered_course_deg, 180.0);
  EXPECT_EQ(ship.state().rate_of_turn_deg_s, 0.0);
  EXPECT_NEAR(metres_between({89.99, 5.0}, ship.state().position), 144.0 * knots_in_mps(30.0),
              1e-3);

  scenario::OwnShip pacific = model(90.0, 30.0);
  pacific.mutable_position()->set_lat(-20.0);
  pacific.mutable_position()->set_lon(179.999);
  OwnShip eastbound(pacific, kCalm, kTick, 0);
  step(eastbound, 1000);
  EXPECT_TRUE(is_sane(eastbound.state().position));
  EXPECT_LT(eastbound.state().position.longitude_deg, -179.98);
}

TEST(OwnShip, IsNeverNaNWhateverTheOrders) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double latitude : {90.0, -90.0, 89.9999999, 0.0}) {
    for (const double time_constant : {0.0, 0.1, 3600.0}) {
      scenario::OwnShip wild = model(360.0, 60.0);
      wild.mutable_position()->set_lat(latitude);
      wild.mutable_position()->set_lon(180.0);
      wild.set_speed_time_constant_s(time_constant);
      wild.set_turn_time_constant_s(time_constant);
      wild.set_max_rate_of_turn_deg_min(720.0);
      OwnShip ship(wild, kCalm, kTick, 0);
      for (int k = 0; k < 5000; ++k) {
        if (k % 50 == 0) ship.order_course(1e6 * unit(random));
        if (k % 77 == 0) ship.order_speed(31.0 * unit(random));
        ship.step(kCalm);
        const ShipState state = ship.state();
        ASSERT_TRUE(is_sane(state.position)) << latitude << ' ' << time_constant << ' ' << k;
        ASSERT_TRUE(state.heading_deg >= 0.0 && state.heading_deg < 360.0);
        ASSERT_TRUE(std::isfinite(state.speed_mps) && std::isfinite(state.rate_of_turn_deg_s));
      }
    }
  }
}

}  // namespace
}  // namespace skerry::server
