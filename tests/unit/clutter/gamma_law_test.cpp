#include "echo/clutter/gamma_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace skerry::echo {
namespace {

double octaves_of(const RankLaw& law, double x) {
  const double t = law.slope * std::clamp(x, double{law.low}, double{law.high}) + law.offset;
  double sum = 0.0;
  for (std::size_t k = law.terms.size(); k-- > 0;) sum = sum * t + law.terms[k];
  return sum;
}

double exact_octaves(double nu, double x) {
  const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
  const double above = 0.5 * std::erfc(x / std::numbers::sqrt2);
  const double value =
      below < 0.5 ? boost::math::gamma_p_inv(nu, below) : boost::math::gamma_q_inv(nu, above);
  return std::log2(std::max(value, 1e-300) / nu);
}

TEST(GammaLaw, IsTheQuantileWithinItsBound) {
  double worst = 0.0, worst_nu = 0.0;
  for (double nu = kLeastShape; nu <= kGreatestShape; nu *= 1.07) {
    const RankLaw law = gamma_law(nu);
    for (double x = law.low; x <= law.high; x += 0.01) {
      const double off = 3.0103 * std::fabs(octaves_of(law, x) - exact_octaves(nu, x));
      if (off > worst) worst = off, worst_nu = nu;
    }
    // The cut-off below: -40 dB, or one of 290 000.
    EXPECT_TRUE(law.low <= -4.4999f || octaves_of(law, law.low) < -13.3) << nu;
  }
  std::printf("worst error %.3f dB at nu %.2f\n", worst, worst_nu);
  EXPECT_LE(worst, 0.14);
}

TEST(GammaLaw, HasTheMomentsOfTheGamma) {
  for (double nu = kLeastShape; nu <= kGreatestShape; nu *= 1.07) {
    const RankLaw law = gamma_law(nu);
    double mean = 0.0, square = 0.0;
    constexpr double kStep = 0.002;
    for (double x = -7.0; x <= 7.0; x += kStep) {
      const double density = kStep * std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      const double value = std::exp2(octaves_of(law, x));
      mean += density * value;
      square += density * value * value;
    }
    EXPECT_NEAR(mean, 1.0, 0.004) << nu;
    EXPECT_NEAR(nu * (square / (mean * mean) - 1.0), 1.0, 0.012) << nu;
  }
}

TEST(GammaLaw, GrowsWithRank) {
  for (const double nu : {0.1, 0.2, 0.7, 3.0, 30.0}) {
    const RankLaw law = gamma_law(nu);
    for (double x = law.low; x < law.high - 0.01; x += 0.01) {
      EXPECT_LT(octaves_of(law, x), octaves_of(law, x + 0.01)) << nu << " at " << x;
    }
  }
}

TEST(GammaLaw, KeepsToItsShapes) {
  EXPECT_EQ(gamma_law(0.001).low, gamma_law(kLeastShape).low);
  EXPECT_EQ(gamma_law(1e9).terms, gamma_law(kGreatestShape).terms);
}

}  // namespace
}  // namespace skerry::echo
