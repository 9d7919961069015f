#include "server/tracking/watch/trial_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/vectors.hpp"
#include "tests/unit/plotter/made_plots.hpp"
#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

wire::TrialOrder order(double course_deg, double speed_kn, double turn_rate = 0.0,
                       double acceleration = 0.0) {
  wire::TrialOrder order;
  order.set_course_deg(course_deg);
  order.set_speed_kn(speed_kn);
  order.set_turn_rate_deg_min(turn_rate);
  order.set_acceleration_kn_min(acceleration);
  return order;
}

// Scenario 1 of A.823(19), and own ship turns to 090: 8 NM / sqrt(2), 8 NM at 20 kn.
TEST(TrialPath, TheFirstScenarioHasTheCpaThatIsKnown) {
  const TrialPath path(order(90.0, 10.0), 0.0, 10.0 * kKnot, 0.0);
  const auto closest = path.closest_to({0.0, 8.0 * kNm}, vector_of(180.0, 10.0 * kKnot));
  EXPECT_NEAR(closest.range_m / kNm, 5.657, 0.0005);
  EXPECT_NEAR(closest.time_s / 60.0, 24.0, 0.001);
}

TEST(TrialPath, NoManoeuvreGivesTheCpaThereIs) {
  const TrialPath path(order(20.0, 12.0), 20.0, 12.0 * kKnot, 600.0);
  const PlanePoint off{3000.0, 7000.0}, mps = vector_of(250.0, 15.0 * kKnot);
  const PlottedApproach plain = closest_approach(off, mps - vector_of(20.0, 12.0 * kKnot));
  const auto closest = path.closest_to(off, mps);
  EXPECT_NEAR(closest.range_m, plain.range_m, 1e-6);
  EXPECT_NEAR(closest.time_s, plain.time_s, 1e-6);
}

TEST(TrialPath, TheClosestMayBeBeforeTheManoeuvreOrInIt) {
  // It passes ahead at 0.5 NM while own ship still waits.
  const PlanePoint off{-1.0 * kNm, 0.5 * kNm};
  const TrialPath waits(order(180.0, 10.0), 0.0, 0.0, 1800.0);
  const auto closest = waits.closest_to(off, vector_of(90.0, 20.0 * kKnot));
  EXPECT_NEAR(closest.range_m, 0.5 * kNm, 0.01);
  EXPECT_NEAR(closest.time_s, 180.0, 0.01);
  // A beacon abeam, and own ship turns a full half circle around it: 180 deg at 30 deg/min.
  const double speed = 12.0 * kKnot, radius = speed / (30.0 / 60.0 / kDegreesPerRadian);
  const TrialPath turns(order(180.0, 12.0, 30.0), 0.0, speed, 0.0);
  const auto beacon = turns.closest_to({radius, 0.0}, {});
  EXPECT_NEAR(beacon.range_m, radius, TrialPath::kBound_m);
  // What is never as close as now.
  const auto away = turns.closest_to({0.0, -5000.0}, vector_of(180.0, 40.0 * kKnot));
  EXPECT_EQ(away.range_m, 5000.0);
  EXPECT_EQ(away.time_s, 0.0);
}

TEST(TrialPath, TurnsTheShorterWayAndToStarboardIfBothAreEqual) {
  const auto is_east = [](double from, double to) {
    const TrialPath path(order(to, 10.0, 90.0), from, 10.0 * kKnot, 0.0);
    const double east = path.closest_to({300.0, 0.0}, {}).range_m;
    const double west = path.closest_to({-300.0, 0.0}, {}).range_m;
    return east < west;
  };
  EXPECT_TRUE(is_east(350.0, 80.0));
  EXPECT_FALSE(is_east(10.0, 280.0));
  EXPECT_TRUE(is_east(0.0, 180.0));
}

// Steps of 10 ms, by the midpoint rule: within 1 mm of the curve for these.
TrialPath::Closest reference(const wire::TrialOrder& order, double course_deg, double speed_mps,
                             double delay_s, PlanePoint off, PlanePoint mps) {
  constexpr double kStep = 0.01;
  const double turn = std::remainder(order.course_deg() - course_deg, 360.0);
  const double rate = order.turn_rate_deg_min() / 60.0;
  const double gain = order.speed_kn() * kKnot - speed_mps;
  const double acceleration = order.acceleration_kn_min() * kKnot / 60.0;
  const auto along = [](double by, double per_s, double t) {
    if (t <= 0.0) return 0.0;
    return per_s <= 0.0 ? by : std::copysign(std::min(std::fabs(by), per_s * t), by);
  };
  TrialPath::Closest closest{length_of(off), 0.0};
  for (double t = 0.0; t < 7200.0; t += kStep) {
    const double at = t + 0.5 * kStep - delay_s;
    const double course = (course_deg + along(turn, rate, at)) / kDegreesPerRadian;
    const double speed = speed_mps + along(gain, acceleration, at);
    off = off + (mps - PlanePoint{std::sin(course), std::cos(course)} * speed) * kStep;
    if (length_of(off) < closest.range_m) closest = {length_of(off), t + kStep};
  }
  return closest;
}

TEST(TrialPath, IsWithinItsBoundOfAFineReference) {
  std::uint64_t state = 5;
  double worst_m = 0.0;
  for (int k = 0; k < 60; ++k) {
    const double course = 359.0 * next_share(state), speed = 30.0 * kKnot * next_share(state);
    const wire::TrialOrder trial =
        order(360.0 * next_share(state), 40.0 * next_share(state),
              k % 4 == 0 ? 0.0 : 2.0 * std::pow(360.0, next_share(state)),
              k % 5 == 0 ? 0.0 : 0.5 * std::pow(120.0, next_share(state)));
    const double delay_s = k % 3 == 0 ? 0.0 : 900.0 * next_share(state);
    const PlanePoint off = vector_of(360.0 * next_share(state), 12.0 * kNm * next_share(state));
    const PlanePoint mps = vector_of(360.0 * next_share(state), 25.0 * kKnot * next_share(state));
    const TrialPath path(trial, course, speed, delay_s);
    const auto told = path.closest_to(off, mps);
    const auto fine = reference(trial, course, speed, delay_s, off, mps);
    if (fine.time_s > 7190.0) continue;  // it ends before they are closest
    worst_m = std::max(worst_m, std::fabs(told.range_m - fine.range_m));
    EXPECT_NEAR(told.range_m, fine.range_m, TrialPath::kBound_m + 0.2) << k;
    EXPECT_LE(path.steps(), 1000u);
  }
  std::printf("worst CPA: %.2f m off\n", worst_m);
}

TEST(TrialPath, HasFewStepsWhateverIsOrdered) {
  for (const double rate : {1e-300, 1e-6, 0.1, 1.0, 720.0}) {
    for (const double acceleration : {1e-300, 1e-6, 0.1, 60.0}) {
      const TrialPath path(order(180.0, 60.0, rate, acceleration), 0.0, 50.0, 1800.0);
      EXPECT_LE(path.steps(), 1000u) << rate << " " << acceleration;
      const auto closest = path.closest_to({1e5, 1e5}, {-10.0, 3.0});
      EXPECT_TRUE(std::isfinite(closest.range_m) && std::isfinite(closest.time_s));
    }
  }
}

}  // namespace
}  // namespace skerry::server
