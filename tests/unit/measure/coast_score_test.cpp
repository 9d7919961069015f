#include "echo/measure/coast_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

// A chord of 800 m to the north-east, and on it `height` sin(waves pi t) to the left.
constexpr double kChord = 800.0;
PlaneLine wave(double height, int waves, double shift_m = 0.0) {
  PlaneLine line;
  const double c = std::sqrt(0.5);
  for (int i = 0; i <= 256; ++i) {
    const double along = kChord * i / 256,
                 off = height * std::sin(waves * std::numbers::pi * i / 256);
    line.push_back({c * (along - off) + shift_m, c * (along + off)});
  }
  return line;
}
PlaneLine straight(double shift_m = 0.0) {
  const double c = std::sqrt(0.5) * kChord;
  return {{shift_m, 0.0}, {c + shift_m, c}};
}

constexpr ScoreScales kScales{.smallest_m = 20.0, .largest_m = 320.0, .least_depth_m = 5.0};
CoastShape shape(const CoastPieces& pieces) {
  return shape_of(pieces, kScales, has_offsets(pieces));
}
CoastScore score(const CoastPieces& real, const CoastPieces& made) {
  const std::vector<bool> chosen = has_offsets(real);
  return score_of(real, shape_of(real, kScales, chosen), made, shape_of(made, kScales, chosen),
                  chosen);
}

TEST(CoastScore, OfTheRealCoastItselfIsNothing) {
  const CoastPieces real = {wave(60.0, 3), wave(20.0, 2, 3000.0)};
  const CoastScore s = score(real, real);
  EXPECT_NEAR(s.real_to_made_p90_m, 0.0, 1e-9);
  EXPECT_NEAR(s.made_to_real_p90_m, 0.0, 1e-9);
  EXPECT_EQ(s.dimension_error, 0.0);
  EXPECT_EQ(s.depth_distance, 0.0);
  EXPECT_EQ(s.width_distance, 0.0);
  EXPECT_EQ(s.spectrum_error, 0.0);
}

TEST(CoastScore, ShapeOfASineWaveIsItsHeightsWidthsAndHarmonic) {
  const CoastShape s = shape({wave(30.0, 3)});
  ASSERT_EQ(s.depths_m.size(), 3u);
  for (double depth : s.depths_m) EXPECT_NEAR(depth, 30.0, 0.1);
  for (double width : s.widths_m) EXPECT_NEAR(width, kChord / 3.0, 3.0);
  EXPECT_NEAR(s.bays_per_km, 3.0 / 0.8, 1e-9);
  // All of it is in the second octave; equal parts of the length differ little from those of the
  // chord for so flat a wave.
  EXPECT_NEAR(s.spectrum[1], 30.0 / kChord, 0.002);
  EXPECT_LT(s.spectrum[0], 0.001);
  EXPECT_LT(s.spectrum[2], 0.004);
}

TEST(CoastScore, OfTheStraightChordSaysWhatIsMissing) {
  const CoastPieces real = {wave(60.0, 3)};
  const CoastScore s = score(real, {straight()});
  EXPECT_EQ(s.depth_distance, 1.0);
  EXPECT_EQ(s.width_distance, 1.0);
  EXPECT_NEAR(s.spectrum_error, 1.0, 1e-9);
  // |sin| has its median at 60 sin(45 deg) by the chord; along the steep curve the median is lower.
  EXPECT_GT(s.real_to_made_p50_m, 30.0);
  EXPECT_LT(s.real_to_made_p50_m, 60.0 * std::sqrt(0.5));
  EXPECT_LE(s.real_to_made_p90_m, 60.0);
}

TEST(CoastScore, ApartIsTheDifferenceInPlace) {
  const CoastPieces real = {wave(60.0, 2)};
  // The rms of a sine is its height over sqrt 2, at equal parts of its length a little less.
  EXPECT_NEAR(score(real, {straight()}).apart_rms_m, 60.0 * std::sqrt(0.5), 3.0);
  EXPECT_NEAR(score(real, {wave(30.0, 2)}).apart_rms_m, 30.0 * std::sqrt(0.5), 2.0);
  EXPECT_NEAR(score(real, {wave(-60.0, 2)}).apart_rms_m, 120.0 * std::sqrt(0.5), 6.0);
}

TEST(CoastScore, AWaveOfTheWrongSignHasTheRightShapeAndTwiceTheOffset) {
  const CoastPieces real = {wave(40.0, 1)};
  const CoastScore wrong = score(real, {wave(-40.0, 1)});
  const CoastScore flat = score(real, {straight()});
  EXPECT_NEAR(wrong.depth_distance, 0.0, 1e-9);
  EXPECT_NEAR(wrong.spectrum_error, 0.0, 1e-9);
  EXPECT_GT(wrong.real_to_made_p50_m, 1.8 * flat.real_to_made_p50_m);
}

TEST(CoastScore, ChanceCannotBeatTheChordInPlace) {
  CoastPieces real, chance, chords;
  for (int i = 0; i < 400; ++i) {
    const auto height = [&](std::uint64_t seed) {
      return 100.0 * (as_unit(mixed(seed, static_cast<std::uint64_t>(i))) - 0.5);
    };
    const double shift = 2000.0 * i;
    real.push_back(wave(height(1), 1, shift));
    chance.push_back(wave(height(2), 1, shift));
    chords.push_back(straight(shift));
  }
  const CoastScore made = score(real, chance), flat = score(real, chords);
  // The squares add up: sqrt 2 times as far, 400 draws.
  EXPECT_NEAR(made.apart_rms_m / flat.apart_rms_m, std::sqrt(2.0), 0.1);
  EXPECT_LT(made.spectrum_error, 0.15);
  EXPECT_LT(made.depth_distance, 0.15);
}

TEST(CoastScore, LoopsHaveNoOffsets) {
  PlaneLine loop = {{0.0, 0.0}, {-500.0, 10.0}, {-500.0, 500.0}, {500.0, 500.0}, {100.0, 0.0}};
  const auto counts = has_offsets({loop, wave(30.0, 1)});
  EXPECT_FALSE(counts[0]);
  EXPECT_TRUE(counts[1]);
}

TEST(CoastScore, KolmogorovSmirnovIsThatOfTwoKnownSamples) {
  const std::vector<double> a = {1, 2, 3, 4}, b = {3, 4, 5, 6}, none;
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(a, b), 0.5);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(a, a), 0.0);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(a, none), 1.0);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov(none, none), 0.0);
  EXPECT_DOUBLE_EQ(quantile_of(a, 0.5), 2.5);
  EXPECT_TRUE(std::isnan(quantile_of(none, 0.5)));
}

TEST(CoastScore, RefusesCoastsThatDoNotBelongTogether) {
  EXPECT_THROW(score({wave(30.0, 1)}, {}), std::invalid_argument);
  EXPECT_THROW(score({wave(30.0, 1)}, {wave(30.0, 1, 5.0)}), std::invalid_argument);
  EXPECT_THROW(shape({PlaneLine{{0.0, 0.0}}}), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::echo
