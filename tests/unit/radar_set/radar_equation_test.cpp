// Vectors of physics.md B0.
#include "echo/radar/radar_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skerry::echo {
namespace {

double dbm(double watts) { return 10.0 * std::log10(watts) + 30.0; }

TEST(RadarEquation, ReceivedPowerOfASquareMetreAtAMile) {
  RadarSet x;
  x.losses_db = 0.0;
  EXPECT_NEAR(dbm(received_watts_of_unit_target(x) / std::pow(1852.0, 4)), -57.638, 0.0005);
  RadarSet s = x;
  s.frequency_hz = 3.05e9;
  s.peak_power_w = 30e3;
  s.antenna_gain_db = 28.0;
  EXPECT_NEAR(dbm(received_watts_of_unit_target(s) / std::pow(1852.0, 4)), -53.060, 0.0005);
}

TEST(RadarEquation, ReceiverNoise) {
  RadarSet set;
  set.noise_figure_db = 6.0;
  EXPECT_NEAR(dbm(noise_watts(set, {0.0, 20e6})), -94.965, 0.0005);
  set.noise_figure_db = 5.0;
  EXPECT_NEAR(dbm(noise_watts(set, {0.0, 3e6})), -104.204, 0.0005);
  EXPECT_NEAR(dbm(noise_watts(set, {0.0, 1e6})), -108.975, 0.0005);
}

TEST(RadarEquation, Horizon) {
  EXPECT_NEAR(radar_horizon(1.0, 0.0) / 1852.0, 2.2256, 0.00005);
  EXPECT_NEAR(radar_horizon(15.0, 3.5) / 1852.0, 12.78, 0.005);
}

TEST(RadarEquation, TheEarthHidesWhatLiesBelowTheHorizon) {
  EXPECT_EQ(hidden_height(10000.0, 20.0), 0.0);
  for (double target : {1.0, 5.0, 60.0}) {
    EXPECT_NEAR(hidden_height(radar_horizon(20.0, target), 20.0), target, 1e-9);
  }
  // Earth drop at 10 NM seen from sea level.
  EXPECT_NEAR(hidden_height(18520.0, 0.0), 20.189, 0.001);
}

}  // namespace
}  // namespace skerry::echo
