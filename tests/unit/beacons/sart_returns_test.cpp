#include "echo/beacons/sart_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::at;
using beacons::hear;
using beacons::hear_turn;
using beacons::kNauticalMile;
using beacons::model_at;
using beacons::Picture;
using beacons::propagation_of;
using beacons::s_band_set;
using beacons::spoke_at;

Scene with_sart(double bearing_deg, double range_m, double height_m = 1.0) {
  Scene scene;
  Sart sart;
  sart.place = at(bearing_deg, range_m);
  sart.height_m = height_m;
  scene.sarts = {sart};
  return scene;
}

RadarSet at_frequency(double hz) {
  RadarSet set;
  set.frequency_hz = hz;
  return set;
}

TEST(SartReturns, SpacingIsThatOfTheSweep) {
  // SOURCES.md "Vectors": 7.9 us are 0.6394 NM, twelve of them 7.673 NM; 95 us in all ("Beacons").
  const double spacing = 0.5 * kLightSpeed * SartSweep::kCycle / kNauticalMile;
  EXPECT_NEAR(spacing, 0.6394, 0.00005);
  EXPECT_NEAR(spacing * SartSweep::kCycles, 7.673, 0.0005);
  EXPECT_NEAR(SartSweep::kCycle * SartSweep::kCycles, 95e-6, 0.5e-6);
}

TEST(SartReturns, AreTwelveDotsOutwardsSixtyFourHundredthsOfAMileApart) {
  const RadarModel model = model_at(12.0);
  const Picture picture = hear_turn(model, with_sart(60.0, 3.0 * kNauticalMile));
  const auto dots = picture.stretches(spoke_at(model, 60.0), 0.3f * picture.most());
  ASSERT_EQ(dots.size(), 12u);
  for (std::size_t i = 1; i < dots.size(); ++i)
    EXPECT_NEAR(dots[i].from_m - dots[0].from_m, static_cast<double>(i) * 0.6394 * kNauticalMile,
                1.01 * model.cell_m);
}

TEST(SartReturns, FirstSlowDotIsUpToTwoThirdsOfAMileBehindTheMark) {
  for (const double hz : {9.2e9, 9.3e9, 9.38e9, 9.41e9, 9.44e9, 9.5e9}) {
    const RadarModel model = model_at(12.0, at_frequency(hz));
    const double range = 3.0 * kNauticalMile;
    const Picture picture = hear(model, with_sart(0.0, range), 0, 16);
    const auto dots = picture.stretches(0, 0.3f * picture.most());
    ASSERT_GE(dots.size(), 12u) << hz;
    EXPECT_GE(dots[0].from_m + model.cell_m, range) << hz;
    EXPECT_LE(dots[0].from_m, range + 0.6394 * kNauticalMile) << hz;
    const double expected = range + 0.5 * kLightSpeed * (0.4e-6 + 7.5e-6 * (hz - 9.2e9) / 300e6);
    EXPECT_NEAR(dots[0].from_m, expected, model.cell_m) << hz;
  }
}

TEST(SartReturns, AreHeardByXBandRadarsInTheirBandAlone) {
  const Scene scene = with_sart(0.0, 3000.0);
  EXPECT_GT(hear(model_at(6.0), scene, 0, 16).most(), 0.0f);
  EXPECT_EQ(hear(model_at(6.0, s_band_set()), scene, 0, 16).most(), 0.0f);
  EXPECT_EQ(hear(model_at(6.0, at_frequency(9.19e9)), scene, 0, 16).most(), 0.0f);
  EXPECT_EQ(hear(model_at(6.0, at_frequency(9.51e9)), scene, 0, 16).most(), 0.0f);
}

TEST(SartReturns, NearAtHandShowTheFastSweepsTooWeakerAndBetweenTheOthers) {
  const RadarModel model = model_at(12.0);
  const double range = 0.7 * kNauticalMile;
  const Picture picture = hear(model, with_sart(0.0, range), 0, 16);
  const auto dots = picture.stretches(0, 1.0f);
  ASSERT_EQ(dots.size(), 24u);
  EXPECT_GE(dots[0].from_m + model.cell_m, range);
  EXPECT_LE(dots[0].from_m, range + 150.0);  // the first fast one
  for (std::size_t i = 2; i < dots.size(); i += 2)
    EXPECT_NEAR(dots[i].from_m - dots[0].from_m,
                static_cast<double>(i / 2) * 0.6394 * kNauticalMile, 1.01 * model.cell_m);
  const auto peak = [&](const Picture::Stretch& s) {
    float most = 0.0f;
    for (double r = s.from_m + 0.5 * model.cell_m; r < s.to_m; r += model.cell_m)
      most = std::max(most, picture.row(0)[static_cast<std::size_t>(r / model.cell_m)]);
    return most;
  };
  EXPECT_LT(peak(dots[0]), peak(dots[1]));
  // Farther off they are lost in the noise, the slow ones not.
  EXPECT_EQ(hear(model, with_sart(0.0, 4.0 * kNauticalMile), 0, 16).stretches(0, 1.0f).size(), 12u);
}

TEST(SartReturns, AreTriggeredToAboutEightMiles) {
  // Farthest range at which an antenna 15 m high and a SART 1 m high make twelve dots.
  RadarSet set;
  set.antenna_height_m = 15.0;
  const RadarModel model = model_at(24.0, set);
  double farthest = 0.0;
  for (double nm = 6.0; nm < 12.0; nm += 0.25)
    if (hear(model, with_sart(0.0, nm * kNauticalMile), 0, 4).most() > 1.0f) farthest = nm;
  RecordProperty("farthest_nm", std::to_string(farthest));
  EXPECT_GT(farthest, 7.0);
  EXPECT_LT(farthest, 10.0);
}

TEST(SartReturns, BecomeArcsWhenNearAndRingsWhenVeryNear) {
  const RadarModel model = model_at(12.0);
  const auto bright = [&](double nm) {
    return static_cast<double>(
               hear_turn(model, with_sart(45.0, nm * kNauticalMile)).bright_spokes(1.0f)) /
           model.geometry.spokes_per_turn;
  };
  const double far = bright(5.0), near = bright(0.8), beside = bright(0.1);
  EXPECT_LT(far, 0.02);
  EXPECT_GT(near, 1.5 * far);
  EXPECT_LT(near, 0.95);
  EXPECT_GT(beside, 0.8);
}

TEST(SartReturns, FallAsTheSquareOfTheRange) {
  const RadarModel model = model_at(12.0);
  const auto strength = [&](double range) {
    const Scene scene = with_sart(0.0, range, 4.0);
    return static_cast<double>(hear(model, scene, 0, 16).most()) /
           static_cast<double>(propagation_of(model, scene).one_way(range, 4.0));
  };
  for (const double range : {1000.0, 2500.0, 5000.0})
    EXPECT_NEAR(std::log2(strength(2.0 * range) / strength(range)), -2.0, 0.15) << range;
}

TEST(SartReturns, AreNotTouchedByTheTune) {
  const RadarModel model = model_at(12.0);
  const Scene scene = with_sart(0.0, 5000.0);
  EXPECT_EQ(hear(model, scene, 0, 16, {}, 16, 1e-4f).cells(), hear(model, scene, 0, 16).cells());
}

TEST(SartReturns, MoveWithTheirRaft) {
  const RadarModel model = model_at(6.0);
  Scene scene = with_sart(0.0, 5000.0);
  scene.sarts[0].velocity = {0.0, -100.0};
  const Picture now = hear(model, scene, 0, 1);
  const Picture later = hear(model, scene, 4096, 1);  // 2.5 s on
  EXPECT_NEAR(now.stretches(0, 1.0f).at(0).from_m - later.stretches(0, 1.0f).at(0).from_m, 250.0,
              1.01 * model.cell_m);
}

TEST(SartReturns, DotLengthIsBandwidthOverThreeHundredMegahertzOfTheSlowSweep) {
  // SOURCES.md "Beacons": 11, 37, 75 m at 3, 10, 20 MHz, while the filter follows the sweep.
  const double rate = 300e6 / 7.5e-6;
  const double expected[3][2] = {{3e6, 11.0}, {10e6, 37.0}, {20e6, 75.0}};
  for (const auto& [bandwidth, metres] : expected)
    EXPECT_NEAR(0.5 * kLightSpeed * bandwidth / rate, metres, 0.5);
  EXPECT_NEAR(0.5 * kLightSpeed * swept_answer(20e6, rate).length_s, 75.0, 0.5);
  EXPECT_NEAR(0.5 * kLightSpeed * swept_answer(10e6, rate).length_s, 37.0, 1.5);
  // A narrower one cannot: it rings on for about 1 / B.
  EXPECT_GT(0.5 * kLightSpeed * swept_answer(3e6, rate).length_s, 20.0);
}

// A chirp of unit power through a Gaussian filter, by brute force: peak power and the length over
// half of it.
SweptAnswer filtered_chirp(double bandwidth, double rate) {
  // |H(f)|^2 = 2^-(2 f / B)^2, so h(t) is exp(-(pi B t)^2 / (2 ln 2)) up to a factor, which follows
  // from H(0) = 1.
  const double decay = M_PI * M_PI * bandwidth * bandwidth / (2.0 * std::log(2.0));
  const double span = 6.0 / std::sqrt(2.0 * decay), step = span / 4000.0;
  double area = 0.0;
  for (double u = -span; u <= span; u += step) area += std::exp(-decay * u * u) * step;
  const auto answer = [&](double t) {
    std::complex<double> sum = 0.0;
    for (double u = -span; u <= span; u += step)
      sum += std::exp(-decay * u * u) * std::polar(1.0, M_PI * rate * (t - u) * (t - u)) *
             (step / area);
    return std::norm(sum);
  };
  const double peak = answer(0.0);
  double low = 0.0, high = 4.0 * (bandwidth / rate + 1.0 / bandwidth);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (answer(middle) > 0.5 * peak ? low : high) = middle;
  }
  return {peak, low + high};
}

TEST(SartReturns, TheAnswerToASweepIsThatOfAGaussianFilter) {
  for (const double bandwidth : {3e6, 5e6, 20e6}) {
    for (const double rate : {300e6 / 7.5e-6, 300e6 / 0.4e-6}) {
      const SweptAnswer formula = swept_answer(bandwidth, rate);
      const SweptAnswer brute = filtered_chirp(bandwidth, rate);
      EXPECT_NEAR(formula.power / brute.power, 1.0, 1e-3) << bandwidth << ' ' << rate;
      EXPECT_NEAR(formula.length_s / brute.length_s, 1.0, 1e-3) << bandwidth << ' ' << rate;
    }
  }
}

}  // namespace
}  // namespace skerry::echo
