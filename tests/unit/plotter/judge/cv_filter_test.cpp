// The baselines' filter against one step reckoned by hand.
#include "server/plotter/judge/baselines/cv_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skerry::server {
namespace {

TEST(CvFilter, PredictsAndUpdates) {
  CvState state = cv_begun({10.0, 0.0}, 25.0, 100.0);
  state.velocity_mps = {1.0, 0.0};
  cv_predict(state, 2.0, 0.0);
  EXPECT_DOUBLE_EQ(state.place.east_m, 12.0);
  EXPECT_DOUBLE_EQ(state.p[0][0], 425.0);  // 25 + 2 s squared of 100
  EXPECT_DOUBLE_EQ(state.p[0][2], 200.0);
  EXPECT_DOUBLE_EQ(state.p[2][0], 200.0);
  const double likelihood = cv_update(state, {9.0, 0.0}, {25.0, 0.0, 25.0});
  EXPECT_NEAR(state.place.east_m, 12.0 + 9.0 * 425.0 / 450.0, 1e-12);
  EXPECT_NEAR(state.velocity_mps.east_m, 1.0 + 9.0 * 200.0 / 450.0, 1e-12);
  EXPECT_EQ(state.place.north_m, 0.0);
  EXPECT_NEAR(state.p[0][0], 425.0 * 25.0 / 450.0, 1e-9);
  EXPECT_NEAR(state.p[2][2], 100.0 - 200.0 * 200.0 / 450.0, 1e-9);
  EXPECT_NEAR(likelihood, std::exp(-0.5 * 81.0 / 450.0) / (2.0 * std::numbers::pi * 450.0), 1e-12);
}

TEST(CvFilter, NoiseIsThatOfAWhiteAcceleration) {
  CvState state = cv_begun({}, 0.0, 0.0);
  cv_predict(state, 2.0, 0.5);
  EXPECT_DOUBLE_EQ(state.p[1][1], 0.5 * 4.0);  // dt^4 / 4
  EXPECT_DOUBLE_EQ(state.p[1][3], 0.5 * 4.0);  // dt^3 / 2
  EXPECT_DOUBLE_EQ(state.p[3][3], 0.5 * 4.0);  // dt^2
  EXPECT_DOUBLE_EQ(state.p[0][1], 0.0);
}

// What is measured well across and badly along a slanted line moves across it.
TEST(CvFilter, HeedsHowTheErrorsOfAMeasurementLie) {
  CvState state = cv_begun({}, 100.0, 1.0);
  // Variance 1e6 along (1, 1), 1 along (1, -1).
  cv_update(state, {10.0, 0.0}, {500'000.5, 499'999.5, 500'000.5});
  EXPECT_NEAR(state.place.east_m, 5.0, 0.1);
  EXPECT_NEAR(state.place.north_m, -5.0, 0.1);
}

}  // namespace
}  // namespace skerry::server
