#include "echo/kernel/bearing_sector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(BearingSector, IsOffByNoMoreThanItsBound) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi), octaves(0.0, 18.0),
      beside(-1e-5, 1e-5);
  const PlanePoint from{1234.5, -777.25};
  std::vector<PlanePoint> points;
  std::vector<double> bearings;
  for (int i = 0; i < 20'000; ++i) {
    // Half of them beside a border.
    const double bearing =
        i % 2 ? turn(random)
              : std::fabs(static_cast<double>(random() % 4096) * std::numbers::pi / 2048.0 +
                          beside(random));
    const double range = std::exp2(octaves(random));
    points.push_back(
        {from.east_m + range * std::sin(bearing), from.north_m + range * std::cos(bearing)});
    bearings.push_back(bearing);
  }
  points.push_back(from);
  std::vector<std::int32_t> first;
  double worst = 0.0;
  on_every_isa([&] {
    std::vector<std::int32_t> out(points.size());
    bearing_sectors(points, from, 4096, out);
    EXPECT_EQ(out.back(), 0);
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      ASSERT_GE(out[i], 0);
      ASSERT_LT(out[i], 4096);
      const double exact = bearings[i] * 2048.0 / std::numbers::pi;
      const double into = std::remainder(exact - (out[i] + 0.5), 4096.0);
      worst = std::max(worst, std::fabs(into) - 0.5);
    }
    if (first.empty()) first = out;
    EXPECT_EQ(out, first);
  });
  const double radians = worst * std::numbers::pi / 2048.0;
  std::printf("a sector's border is off by %.3g rad at most\n", radians);
  EXPECT_LE(radians, 2e-6);
}

}  // namespace
}  // namespace skerry::echo
