#include "protocol/quantity/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skerry {
namespace {

TEST(Angle, HoldsWholeDegreesExactly) {
  for (int d = -100'000; d <= 100'000; ++d) {
    ASSERT_EQ(degrees(d).in_degrees(), d);
  }
}

TEST(Angle, IsUnbounded) { EXPECT_EQ((degrees(300) + degrees(300)).in_degrees(), 600); }

TEST(Angle, TurnsDegreesIntoRadiansAndBack) {
  const double pi = std::acos(-1.0);
  EXPECT_DOUBLE_EQ(degrees(180).in_radians(), pi);
  EXPECT_DOUBLE_EQ(radians(pi / 2).in_degrees(), 90);
  for (int d = -720; d <= 720; ++d) {
    ASSERT_NEAR(radians(degrees(d).in_radians()).in_degrees(), d, 1e-12 * std::abs(d));
  }
}

TEST(Angle, AddsScalesAndCompares) {
  EXPECT_EQ(degrees(30) + degrees(60), degrees(90));
  EXPECT_EQ(degrees(30) - degrees(60), degrees(-30));
  EXPECT_EQ(-degrees(30), degrees(-30));
  EXPECT_EQ(degrees(30) * 3, degrees(90));
  EXPECT_EQ(3 * degrees(30), degrees(90));
  EXPECT_EQ(degrees(30) / 4, degrees(7.5));
  EXPECT_EQ(degrees(30) / degrees(60), 0.5);
  EXPECT_LT(degrees(-1), degrees(1));
}

}  // namespace
}  // namespace skerry
