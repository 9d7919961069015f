#include "echo/measure/graph_roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/unit/measure/exact_fbm.hpp"

namespace skerry::echo {
namespace {

using test::exact_fbm;

constexpr std::size_t kSteps = 4096;
constexpr int kGraphs = 60;

struct Moments {
  double mean = 0.0, sd = 0.0;
};
template <typename Value>
Moments moments_of(Value&& value) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kGraphs; ++i) {
    const double v = value(i);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / kGraphs;
  return {mean, std::sqrt(std::fmax(0.0, squares / kGraphs - mean * mean))};
}

// The generator first: increments have the covariance of fractional Gaussian noise.
TEST(ExactFbm, HasTheVariancesAndCovariancesOfFractionalBrownianMotion) {
  for (double hurst : {0.6, 0.75, 0.9}) {
    double v16 = 0.0, beside = 0.0;
    constexpr int kMany = 400;
    for (std::uint64_t seed = 0; seed < kMany; ++seed) {
      const auto h = exact_fbm(64, hurst, seed);
      v16 += h[16] * h[16] / kMany;
      beside += h[1] * (h[2] - h[1]) / kMany;
    }
    // Sample variances of 400 normal numbers are off by sqrt(2 / 400) = 7 %; four of that.
    EXPECT_NEAR(v16 / std::pow(16.0, 2.0 * hurst), 1.0, 0.28);
    EXPECT_NEAR(beside, std::exp2(2.0 * hurst - 1.0) - 1.0, 0.28);
  }
}

// D, and what SOURCES.md "Fractals" measured: mean and scatter of the variogram.  Bound: its own
// bias there
// (+0.007) doubled, and three standard errors of a mean of 60.
TEST(GraphRoughness, FindsTheDimensionOfExactFractionalBrownianMotion) {
  struct Case {
    double dimension, scatter;
  };
  for (const Case c : {Case{1.40, 0.015}, Case{1.25, 0.019}, Case{1.10, 0.038}}) {
    int within = 0;
    const Moments variogram = moments_of([&](int i) {
      const auto estimate = variogram_dimension(
          exact_fbm(kSteps, 2.0 - c.dimension, static_cast<std::uint64_t>(1000 + i)));
      within += estimate.interval95.low < c.dimension && c.dimension < estimate.interval95.high;
      return estimate.dimension;
    });
    const Moments madogram = moments_of([&](int i) {
      return madogram_dimension(
                 exact_fbm(kSteps, 2.0 - c.dimension, static_cast<std::uint64_t>(1000 + i)))
          .dimension;
    });
    std::printf("D %.2f: variogram %.3f sd %.3f, madogram %.3f sd %.3f, within 95 %%: %d of %d\n",
                c.dimension, variogram.mean, variogram.sd, madogram.mean, madogram.sd, within,
                kGraphs);
    const double bound = 0.014 + 3.0 * c.scatter / std::sqrt(double{kGraphs});
    EXPECT_NEAR(variogram.mean, c.dimension, bound);
    EXPECT_NEAR(madogram.mean, c.dimension, bound);
    EXPECT_LT(variogram.sd, 1.5 * c.scatter);
    EXPECT_GE(within, kGraphs * 85 / 100);
  }
}

TEST(GraphRoughness, SecondDifferencesSeeThroughPinnedEnds) {
  // A slope laid on the graph changes the variogram and not the second differences.
  auto h = exact_fbm(kSteps, 0.9, 3);
  const auto before = second_variation(h, 16);
  for (std::size_t i = 0; i < h.size(); ++i) h[i] += 5.0 * static_cast<double>(i);
  const auto after = second_variation(h, 16);
  ASSERT_EQ(before.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(after[k].mean / before[k].mean, 1.0, 1e-6);
  EXPECT_GT(graph_variation(h, 2.0, 16)[4].mean, 2.0 * before[4].mean);
}

TEST(GraphRoughness, GraphsThatSayNothingHaveNoDimension) {
  EXPECT_TRUE(std::isnan(variogram_dimension(std::vector<double>(100, 1.0)).dimension));
  EXPECT_TRUE(std::isnan(variogram_dimension(std::vector<double>(4096, 1.0)).dimension));
  EXPECT_TRUE(std::isnan(madogram_dimension({}).dimension));
  EXPECT_TRUE(graph_variation({}, 2.0, 8).empty());
  EXPECT_TRUE(power_spectrum(std::vector<double>(31, 1.0)).empty());
}

TEST(GraphRoughness, AStraightSlopeHasDimensionOne) {
  std::vector<double> h(4097);
  for (std::size_t i = 0; i < h.size(); ++i) h[i] = 0.25 * static_cast<double>(i);
  EXPECT_NEAR(variogram_dimension(h).dimension, 1.0, 1e-9);
  EXPECT_NEAR(madogram_dimension(h).dimension, 1.0, 1e-9);
}

// White noise of variance 1: the window leaves 3/8 of its power, in every octave.
TEST(PowerSpectrum, OfWhiteNoiseIsFlat) {
  const Moments slope = moments_of([](int i) {
    const auto motion = exact_fbm(kSteps, 0.5, static_cast<std::uint64_t>(i));
    std::vector<double> noise(kSteps);
    for (std::size_t k = 0; k < kSteps; ++k) noise[k] = motion[k + 1] - motion[k];
    const auto spectrum = power_spectrum(noise);
    EXPECT_NEAR(spectrum.back().power, 0.375, 0.375);
    return spectrum_slope(spectrum).slope;
  });
  EXPECT_NEAR(slope.mean, 0.0, 0.06);
}

TEST(PowerSpectrum, FallsAsTheDimensionSays) {
  for (double dimension : {1.4, 1.25, 1.1}) {
    const Moments found = moments_of([&](int i) {
      const auto h = exact_fbm(kSteps, 2.0 - dimension, static_cast<std::uint64_t>(1000 + i));
      return (5.0 + spectrum_slope(power_spectrum(h)).slope) / 2.0;
    });
    std::printf("D %.2f: spectrum %.3f sd %.3f\n", dimension, found.mean, found.sd);
    EXPECT_NEAR(found.mean, dimension, 0.03);
  }
}

TEST(PowerSpectrum, ShowsASineInItsOctave) {
  std::vector<double> h(1024);
  for (std::size_t i = 0; i < h.size(); ++i)
    h[i] = std::sin(2.0 * std::numbers::pi * static_cast<double>(i) * 48.0 / 1024.0);
  const auto spectrum = power_spectrum(h);
  std::size_t loudest = 0;
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    if (spectrum[k].power > spectrum[loudest].power) loudest = k;
  }
  EXPECT_NEAR(spectrum[loudest].cycles_per_step * 1024.0, 32.0 * std::sqrt(2.0), 1e-9);
}

}  // namespace
}  // namespace skerry::echo
