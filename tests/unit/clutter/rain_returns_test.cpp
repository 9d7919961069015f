#include "echo/clutter/rain_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "echo/radar/antenna_pattern.hpp"
#include "echo/radar/radar_equation.hpp"
#include "tests/unit/clutter/clutter_scene.hpp"

namespace skerry::echo {
namespace {

// The clutter width of sea_radar()'s antenna, by its beam.
const double kWidth = AntennaPattern(RadarSet{}).clutter_width();

TEST(RainReflectivity, HasTheVectorsOfTheFacts) {
  EXPECT_NEAR(rain_reflectivity(9.41e9, 4.0), 5.077e-7, 0.0005e-7);
  EXPECT_NEAR(rain_reflectivity(9.41e9, 16.0), 4.666e-6, 0.0005e-6);
  EXPECT_NEAR(10.0 * std::log10(rain_reflectivity(9.41e9, 4.0)), -62.94, 0.005);
  EXPECT_NEAR(10.0 * std::log10(rain_reflectivity(9.41e9, 16.0)), -53.31, 0.005);
  EXPECT_NEAR(10.0 * std::log10(rain_reflectivity(9.41e9, 4.0) / rain_reflectivity(3.05e9, 4.0)),
              19.57, 0.005);
  EXPECT_EQ(rain_reflectivity(9.41e9, 0.0), 0.0);
}

// Pr = Pt G^2 lambda^2 th phi c tau eta / (1024 ln2 pi^2 R^2 L), whose horizontal width is that of
// a Gaussian beam; the cosine taper's is 1 % narrower.
TEST(RainReturns, AreThoseOfProbertJones) {
  const RadarModel model = sea_radar(12.0);
  const RadarSet& set = model.set;
  const double lambda = set.wavelength_m(), degree = std::numbers::pi / 180.0;
  const double gain = std::pow(10.0, 0.1 * set.antenna_gain_db);
  for (const double range : {1000.0, 5000.0, 12000.0}) {
    const double watts = set.peak_power_w * gain * gain * lambda * lambda * set.beam_width_deg *
                         degree * set.vertical_beam_deg * degree * kLightSpeed *
                         model.pulse.length_s * rain_reflectivity(set.frequency_hz, 1.0) /
                         (1024.0 * std::numbers::ln2 * std::numbers::pi * std::numbers::pi * range *
                          range * std::pow(10.0, 0.1 * set.losses_db));
    const double expected = watts / noise_watts(set, model.pulse);
    EXPECT_NEAR(10.0 * std::log10(rain_level(model, kWidth, range) / expected), 0.0, 0.1) << range;
  }
}

// Rain at one rate from cell `first` on, that dims nothing.
struct EvenRain {
  std::vector<float> echoes, left;
  EvenRain(double rate, float transmission = 1.0f) : echoes(300), left(300, transmission) {
    rain_echoes(std::vector<float>(300, static_cast<float>(rate)), echoes);
  }
  RainKnots knots(std::size_t first, std::size_t end) const {
    return {echoes, left, 16, first, end};
  }
};

// Averages over many spokes of rain at one rate.
std::vector<double> mean_echo(const RadarModel& model, double rate, int spokes) {
  const RainReturns rain(model);
  const EvenRain even(rate);
  std::vector<double> mean(model.geometry.cells, 0.0);
  std::vector<float> power(model.geometry.cells);
  for (int k = 0; k < spokes; ++k) {
    SpokeAim aim;
    aim.scan = static_cast<std::uint32_t>(k / 64);
    aim.index = static_cast<std::uint32_t>(k % 64 * 64);
    std::fill(power.begin(), power.end(), 0.0f);
    rain.pass(5, aim, even.knots(0, model.geometry.cells), power);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += power[i] / double{1} / spokes;
  }
  return mean;
}

double slope(const std::vector<double>& mean, const RadarModel& model, double from_m, double to_m) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double range = (static_cast<double>(i) + 0.5) * model.cell_m;
    if (range < from_m || range > to_m) continue;
    const double a = std::log(range), b = std::log(mean[i]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

TEST(RainReturns, FallAsTheSquareOfRangeWhileTheBeamIsFilled) {
  const RadarModel model = sea_radar(24.0);
  const std::vector<double> mean = mean_echo(model, 4.0, 6400);
  const double near = slope(mean, model, 500.0, 13000.0);
  const double far = slope(mean, model, 15000.0, 44000.0);
  std::printf("slope %.3f in filled beam, %.3f over the rain's top\n", near, far);
  EXPECT_NEAR(near, -2.0, 0.02);
  EXPECT_NEAR(far, -3.0, 0.03);
}

TEST(RainReturns, GrowWithTheRateToThePowerOf1Point6) {
  const RadarModel model = sea_radar(6.0);
  const std::vector<double> light = mean_echo(model, 4.0, 640), heavy = mean_echo(model, 16.0, 640);
  for (std::size_t i = 10; i < light.size(); i += 50) {
    EXPECT_NEAR(10.0 * std::log10(heavy[i] / light[i]), 16.0 * std::log10(4.0), 0.01);
  }
}

TEST(RainReturns, FluctuateAsAnExponentialAndForgetInAFewSpokes) {
  const RadarModel model = sea_radar(6.0);
  const RainReturns rain(model);
  const EvenRain even(4.0);
  std::vector<float> power(1024), other(1024);
  double mean = 0, square = 0, decibels = 0, squares = 0, product = 0;
  int count = 0;
  const double at_one_metre = rain_level(model, kWidth, 1000.0) * 1e6 * std::pow(4.0, 1.6);
  for (std::uint32_t s = 0; s < 4000; s += 20) {
    SpokeAim aim;
    aim.index = s;
    std::fill(power.begin(), power.end(), 0.0f);
    rain.pass(5, aim, even.knots(0, 1024), power);
    aim.index = s + 15;  // 9 ms, a beam width
    std::fill(other.begin(), other.end(), 0.0f);
    rain.pass(5, aim, even.knots(0, 1024), other);
    for (std::size_t i = 20; i < 1024; ++i) {
      const double range = (static_cast<double>(i) + 0.5) * model.cell_m;
      const double level = at_one_metre / (range * range);
      const double v = power[i] / level, w = other[i] / level, db = 10.0 * std::log10(v);
      mean += v, square += v * v, decibels += db, squares += db * db, product += v * w, ++count;
    }
  }
  mean /= count, decibels /= count;
  // Some 7000 independent values.
  EXPECT_NEAR(mean, 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count - decibels * decibels), 5.57, 0.25);
  EXPECT_NEAR((product / count - mean * mean) / (square / count - mean * mean), 0.0, 0.06);
}

TEST(RainReturns, KeepToTheCellsWithRainAndDimAllBehind) {
  const RadarModel model = sea_radar(6.0);
  const RainReturns rain(model);
  const EvenRain even(4.0, 0.5f);
  std::vector<float> power(1024, 0.0f);
  rain.pass(5, SpokeAim{}, even.knots(300, 500), power);
  for (std::size_t i = 0; i < 1024; ++i) EXPECT_EQ(power[i] > 0.0f, i >= 300 && i < 500) << i;
  std::vector<float> steady(1024, 1.0f);
  rain.pass(5, SpokeAim{}, even.knots(300, 500), steady);
  for (std::size_t i = 0; i < 1024; ++i) {
    EXPECT_FLOAT_EQ(steady[i], i < 300 ? 1.0f : 0.5f + power[i]) << i;
  }
  rain.pass(5, SpokeAim{}, even.knots(1024, 1024), power);
  rain.pass(5, SpokeAim{}, even.knots(1000, 9999), power);
}

}  // namespace
}  // namespace skerry::echo
