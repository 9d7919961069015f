// Filters of a target's motion, beside slow sums.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/plotter/motion/imm_filter.hpp"
#include "server/plotter/motion/straight_filter.hpp"
#include "tests/unit/plotter/made_plots.hpp"

namespace skerry::server {
namespace {

MotionState moving(double east_mps, double north_mps, double turn_rad_s = 0.0) {
  MotionState state;
  state.mean << 0.0, 0.0, east_mps, north_mps, turn_rad_s;
  state.covariance.diagonal() << 100.0, 100.0, 4.0, 4.0, 1e-4;
  return state;
}

MeasuredPlace measured(double east_m, double north_m, double sigma_m) {
  MeasuredPlace place;
  place.place << east_m, north_m;
  place.covariance *= sigma_m * sigma_m;
  return place;
}

// A turn, beside its sum in steps of a millisecond: rates about the series' border of 0.1 rad, too.
TEST(MotionModel, TurnsAsTheSumOfSmallSteps) {
  for (const double rate : {0.0, 1e-9, 0.01, -0.049, 0.051, 0.3, -0.6}) {
    MotionState state = moving(3.0, 8.0, rate);
    predict(state, {.turns = true}, 2.0);
    double east = 0.0, north = 0.0, heading = std::atan2(3.0, 8.0);
    const double speed = std::sqrt(9.0 + 64.0);
    for (int i = 0; i < 2000; ++i) {
      heading += rate * 0.0005;
      east += speed * std::sin(heading) * 0.001;
      north += speed * std::cos(heading) * 0.001;
      heading += rate * 0.0005;
    }
    EXPECT_NEAR(state.mean(0), east, 1e-5) << rate;
    EXPECT_NEAR(state.mean(1), north, 1e-5) << rate;
    EXPECT_NEAR(state.mean(2), speed * std::sin(heading), 1e-9) << rate;
    EXPECT_NEAR(state.mean(3), speed * std::cos(heading), 1e-9) << rate;
  }
}

// What an error of the rate does to the place, by the model's matrix and by differences.
TEST(MotionModel, KnowsWhatAnErrorOfTheRateDoes) {
  for (const double rate : {0.0, 0.02, -0.2}) {
    MotionState state = moving(3.0, 8.0, rate), one = state, other = state;
    state.covariance.setZero();
    state.covariance(4, 4) = 1e-6;
    const MotionModel turn{.turns = true};
    constexpr double kSmall = 1e-5;
    one.mean(4) += kSmall;
    other.mean(4) -= kSmall;
    predict(state, turn, 3.0);
    predict(one, turn, 3.0);
    predict(other, turn, 3.0);
    for (int i = 0; i < 4; ++i) {
      const double slope = (one.mean(i) - other.mean(i)) / (2.0 * kSmall);
      EXPECT_NEAR(state.covariance(i, 4) / 1e-6, slope, 1e-3 + 1e-5 * std::fabs(slope)) << i;
    }
  }
}

TEST(MotionModel, StaysACovarianceForHours) {
  MotionState state = moving(5.0, 5.0, 0.01);
  const MotionModel models[] = {
      {.acceleration = 0.1, .turns = true, .turn_change = 1e-6},
      {.acceleration = 1e-5},
      {.acceleration = 0.1, .turn_ahead = 0.02},
  };
  for (int i = 0; i < 5000; ++i) {
    predict(state, models[i % 3], 2.5);
    const MeasuredPlace place = measured(state.mean(0), state.mean(1), 1e-3 + 30.0 * (i % 7));
    correct(state, place, innovation(state, place));
    ASSERT_GE(state.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-9)
        << i;
  }
}

// Straight motion: the filter is the line of least squares.
TEST(StraightFilter, IsTheLineOfLeastSquares) {
  StraightFilter filter({.model = {}});
  std::uint64_t draws = 3;
  double sum_t = 0.0, sum_tt = 0.0, sum_x = 0.0, sum_tx = 0.0;
  constexpr int kPlots = 40;
  for (int i = 0; i < kPlots; ++i) {
    const double t = 2.5 * i, x = 100.0 + 6.0 * t + 20.0 * next_draw(draws);
    const MeasuredPlace place = measured(x, 0.0, 20.0);
    if (i == 0) {
      MotionState state;
      state.mean << x, 0.0, 0.0, 0.0, 0.0;
      state.covariance.diagonal() << 400.0, 400.0, 1e8, 1e8, 0.0;
      filter.start(state);
    } else {
      filter.predict(2.5);
      filter.correct(place, innovation(filter.state(), place).log2_density);
    }
    sum_t += t, sum_tt += t * t, sum_x += x, sum_tx += t * x;
  }
  const double slope = (kPlots * sum_tx - sum_t * sum_x) / (kPlots * sum_tt - sum_t * sum_t);
  EXPECT_NEAR(filter.state().mean(2), slope, 1e-4);
  EXPECT_EQ(filter.doubt_bits(), 0.0);
  // Its own certainty is the line's: sigma / (T sqrt(n^3 / 12)).
  EXPECT_NEAR(std::sqrt(filter.state().covariance(2, 2)),
              20.0 / (2.5 * std::sqrt(kPlots * (kPlots * kPlots - 1.0) / 12.0)), 1e-4);
}

TEST(ImmFilter, KnowsWhetherItsTargetTurnsOrChangesItsSpeed) {
  ImmFilter filter;
  StraightFilter straight;
  std::uint64_t draws = 9;
  filter.start(moving(0.0, 8.0));
  straight.start(moving(0.0, 8.0));
  double east = 0.0, north = 0.0, course = 0.0, speed = 8.0;
  bool told = false;
  const auto sail = [&](int turns, double turn_deg_s, double change_mps2) {
    for (int i = 0; i < turns; ++i) {
      for (int k = 0; k < 25; ++k) {
        course += turn_deg_s / kDegreesPerRadian * 0.1;
        speed += change_mps2 * 0.1;
        east += speed * std::sin(course) * 0.1;
        north += speed * std::cos(course) * 0.1;
      }
      const MeasuredPlace place =
          measured(east + 5.0 * next_draw(draws), north + 5.0 * next_draw(draws), 5.0);
      filter.predict(2.5);
      straight.predict(2.5);
      const double density = filter.correct(place);
      if (straight.correct(place, density)) {
        told = true;
        straight.start(filter.state());
      }
    }
  };
  sail(60, 0.0, 0.0);
  EXPECT_GT(filter.share(ImmFilter::steady), 0.5);
  EXPECT_FALSE(told);
  EXPECT_LT(length_of(straight.state().velocity() - PlanePoint{0.0, 8.0}), 0.3);
  sail(12, 2.0, 0.0);
  EXPECT_TRUE(told) << "within half a minute";
  EXPECT_GT(filter.share(ImmFilter::turning), filter.share(ImmFilter::steady));
  EXPECT_NEAR(filter.state().mean(4) * kDegreesPerRadian, 2.0, 1.0);
  sail(40, 0.0, 0.0);
  told = false;
  sail(10, 0.0, -0.25);
  EXPECT_TRUE(told);
  EXPECT_NEAR(length_of(filter.state().velocity()), speed, 1.5);
}

TEST(ImmFilter, GoesOnForTenMinutesWithoutASighting) {
  ImmFilter filter;
  filter.start(moving(3.0, 4.0));
  filter.predict(600.0);
  EXPECT_NEAR(filter.state().mean(0), 1800.0, 300.0);
  EXPECT_TRUE(filter.state().covariance.allFinite());
  filter.predict(-5.0);
  filter.predict(0.0);
  EXPECT_NEAR(filter.state().mean(0), 1800.0, 300.0);
}

}  // namespace
}  // namespace skerry::server
