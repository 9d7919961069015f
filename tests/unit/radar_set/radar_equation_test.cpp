// Numbers of SOURCES.md "Vectors".
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
  EXPECT_NEAR(radar_horizon(1.0, 0.0) / 1000.0, 4.1218, 0.00005);
  EXPECT_NEAR(radar_horizon(15.0, 3.5) / 1852.0, 12.78, 0.005);
}

TEST(RadarEquation, WavelengthsOfTheTwoBands) {
  RadarSet set;
  set.frequency_hz = 9.41e9;
  EXPECT_NEAR(set.wavelength_m(), 0.0318589, 5e-8);
  set.frequency_hz = 3.05e9;
  EXPECT_NEAR(set.wavelength_m(), 0.0982926, 5e-8);
}

TEST(RadarEquation, DepthOfPulses) {
  const double us[] = {0.05, 0.07, 0.08, 0.25, 0.75, 1.0, 1.2};
  const double depth[] = {7.49, 10.49, 11.99, 37.47, 112.42, 149.90, 179.88};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(pulse_depth_m(us[i] * 1e-6), depth[i], 0.0051);
}

TEST(RadarEquation, RangesThatAreNotAmbiguous) {
  const double prf[] = {600, 1000, 1800, 3000, 3600};
  const double nm[] = {134.90, 80.94, 44.97, 26.98, 22.48};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(unambiguous_range_m(prf[i]) / 1852.0, nm[i], 0.0051);
}

TEST(RadarEquation, HitsOfABeamThatPasses) {
  EXPECT_NEAR(hits_per_scan(1.0, 600.0, 24.0), 4.17, 0.005);
  EXPECT_NEAR(hits_per_scan(1.0, 1000.0, 24.0), 6.94, 0.005);
  EXPECT_NEAR(hits_per_scan(1.0, 3000.0, 24.0), 20.83, 0.005);
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
