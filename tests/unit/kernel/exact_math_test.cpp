#include "echo/kernel/exact_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace skerry::echo {
namespace {

TEST(ExactMath, SineAndCosineAreCloseToLibm) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-1000.0, 1000.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double degrees = angle(random);
    const long double exact = degrees * (std::numbers::pi_v<long double> / 180.0L);
    const SinCos v = sin_cos_degrees(degrees);
    worst = std::max({worst, std::fabs(static_cast<double>(v.sin - std::sin(exact))),
                      std::fabs(static_cast<double>(v.cos - std::cos(exact)))});
  }
  std::printf("worst error of sine and cosine: %.3g\n", worst);
  EXPECT_LE(worst, 4e-16);
}

TEST(ExactMath, SineAndCosineAreExactAtQuarterTurns) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const SinCos v = sin_cos_degrees(90.0 * quarter);
    const int q = ((quarter % 4) + 4) % 4;
    EXPECT_EQ(v.sin, q == 1 ? 1.0 : q == 3 ? -1.0 : 0.0);
    EXPECT_EQ(v.cos, q == 0 ? 1.0 : q == 2 ? -1.0 : 0.0);
  }
  EXPECT_EQ(sin_cos_units(0x40000000u).sin, 1.0);
  EXPECT_EQ(sin_cos_units(0x80000000u).cos, -1.0);
  EXPECT_EQ(sin_cos_units(0xC0000000u).sin, -1.0);
}

TEST(ExactMath, UnitsAndDegreesAgree) {
  std::mt19937 random(2);
  for (int i = 0; i < 10000; ++i) {
    const auto units = static_cast<std::uint32_t>(random());
    const SinCos a = sin_cos_units(units), b = sin_cos_degrees(units * (360.0 / 4294967296.0));
    EXPECT_NEAR(a.sin, b.sin, 4e-16);
    EXPECT_NEAR(a.cos, b.cos, 4e-16);
  }
}

TEST(ExactMath, ArcTangentIsCloseToLibm) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0), sign(-1.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double y = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    const double x = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    worst = std::max(worst, std::fabs(exact_atan2(y, x) - std::atan2(y, x)));
  }
  std::printf("worst error of atan2: %.3g rad\n", worst);
  EXPECT_LE(worst, 1e-15);
  EXPECT_EQ(exact_atan2(0.0, 0.0), 0.0);
  EXPECT_NEAR(exact_atan2(0.0, -1.0), std::numbers::pi, 1e-15);
  EXPECT_NEAR(exact_atan2(-1.0, 0.0), -std::numbers::pi / 2, 1e-15);
}

TEST(ExactMath, LogarithmAndPowerAreCloseToLibm) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  double worst_log = 0.0, worst_exp = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = std::exp2(exponent(random));
    const double truth = std::log2(x);
    worst_log =
        std::max(worst_log, std::fabs(exact_log2(x) - truth) / std::max(1.0, std::fabs(truth)));
    const double e = exponent(random);
    worst_exp = std::max(worst_exp, std::fabs(exact_exp2(e) / std::exp2(e) - 1.0));
  }
  std::printf("worst error of log2: %.3g, of exp2: %.3g\n", worst_log, worst_exp);
  EXPECT_LE(worst_log, 2e-15);
  EXPECT_LE(worst_exp, 1e-15);
  EXPECT_EQ(exact_log2(1.0), 0.0);
  EXPECT_EQ(exact_log2(1024.0), 10.0);
}

TEST(ExactMath, DecibelsGoBothWays) {
  for (double db = -200.0; db <= 200.0; db += 0.37) {
    EXPECT_NEAR(decibels_from_ratio(ratio_from_decibels(db)), db, 1e-12);
  }
  EXPECT_NEAR(ratio_from_decibels(30.0), 1000.0, 1e-10);
}

}  // namespace
}  // namespace skerry::echo
