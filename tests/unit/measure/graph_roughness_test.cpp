#include "echo/measure/graph_roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/measure/exact_fbm.hpp"

namespace skerry::echo {
namespace {

using test::exact_fbm;

constexpr std::size_t kSteps = 4096;

// The generator: increments have the covariance of fractional Gaussian noise.
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

TEST(GraphRoughness, SecondDifferencesSeeThroughPinnedEnds) {
  // A slope laid on the graph leaves them as they are.
  auto h = exact_fbm(kSteps, 0.9, 3);
  const auto before = second_variation(h, 16);
  for (std::size_t i = 0; i < h.size(); ++i) h[i] += 5.0 * static_cast<double>(i);
  const auto after = second_variation(h, 16);
  ASSERT_EQ(before.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(after[k].mean / before[k].mean, 1.0, 1e-6);
}

}  // namespace
}  // namespace skerry::echo
