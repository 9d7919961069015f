#include "echo/returns/hidden_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

constexpr double kAntenna = 20.0;

double slope_of(double height, double range) {
  return (height - kAntenna) / range - range / (2.0 * kEffectiveEarth);
}

TEST(HiddenWater, ComesIntoSightWhereTheLineOverTheRidgeMeetsTheSea) {
  for (double range = 300.0; range < 12000.0; range *= 1.3) {
    for (const double height : {1.0, 4.0, 10.0, 15.0}) {
      const double from = sea_seen_from(slope_of(height, range), kAntenna);
      if (std::isinf(from)) continue;
      EXPECT_GT(from, range);
      EXPECT_NEAR(slope_of(0.0, from), slope_of(height, range), 1e-12);
    }
  }
  // Land as high as the antenna hides all the sea behind it.
  EXPECT_TRUE(std::isinf(sea_seen_from(slope_of(20.0, 1000.0), kAntenna)));
}

TEST(HiddenWater, IsDryFromTheShoreToTheEndOfTheShadow) {
  // Low and high land on cells of 10 m: slopes stand for 4 m at 1500 m, then for 30 m at 4000 m.
  std::vector<float> slopes(1000, -1e9f);
  for (std::size_t i = 150; i < 1000; ++i) slopes[i] = static_cast<float>(slope_of(4.0, 1500.0));
  for (std::size_t i = 401; i < 1000; ++i) slopes[i] = static_cast<float>(slope_of(30.0, 4000.0));
  const std::vector<LandInterval> land = {{1000.0, 1500.0}, {3500.0, 4001.0}};
  std::vector<CellRun> dry;
  find_dry(land, slopes, 10.0, kAntenna, 1000, dry);
  ASSERT_EQ(dry.size(), 2u);
  EXPECT_EQ(dry[0].first, 100);
  const double out = sea_seen_from(slope_of(4.0, 1500.0), kAntenna);
  EXPECT_NEAR(dry[0].last, out / 10.0, 1.0);
  EXPECT_EQ(dry[1], (CellRun{350, 1000}));
  find_dry({}, slopes, 10.0, kAntenna, 1000, dry);
  EXPECT_TRUE(dry.empty());
}

}  // namespace
}  // namespace skerry::echo
