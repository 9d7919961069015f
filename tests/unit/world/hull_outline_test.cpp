// Outlines of ships: when two of them touch, against a slow reference.
#include "server/world/hull_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <vector>

#include "tests/unit/world/slow_outline.hpp"

namespace skerry::server {
namespace {

TEST(HullOutline, HasAPointedBowAndASquareStern) {
  const HullOutline north = hull_outline(100.0, 20.0, 0.0);
  EXPECT_EQ(north[0], (PlanePoint{0.0, 50.0}));
  EXPECT_EQ(north[1], (PlanePoint{10.0, 25.0}));
  EXPECT_EQ(north[2], (PlanePoint{10.0, -50.0}));
  EXPECT_EQ(north[3], (PlanePoint{-10.0, -50.0}));
  EXPECT_EQ(north[4], (PlanePoint{-10.0, 25.0}));
  const HullOutline east = hull_outline(100.0, 20.0, 90.0);
  EXPECT_EQ(east[0], (PlanePoint{50.0, 0.0}));
  EXPECT_EQ(east[1], (PlanePoint{25.0, -10.0})) << "her starboard side is to the south";
}

TEST(HullOutline, TouchesWhereSidesMeet) {
  const HullOutline north = hull_outline(100.0, 20.0, 0.0), east = hull_outline(100.0, 20.0, 90.0);
  EXPECT_TRUE(outlines_touch(north, north, {20.0, 0.0})) << "side by side";
  EXPECT_FALSE(outlines_touch(north, north, {20.01, 0.0}));
  EXPECT_TRUE(outlines_touch(north, north, {0.0, 100.0})) << "bow to stern";
  EXPECT_FALSE(outlines_touch(north, north, {0.0, 100.01}));
  // Heading east, her bow's point reaches 50 m ahead of her.
  EXPECT_TRUE(outlines_touch(north, east, {-60.0, 0.0})) << "a bow in a side";
  EXPECT_FALSE(outlines_touch(north, east, {-60.01, 0.0}));
  // Where rectangles would touch: past the bow's shoulder.
  EXPECT_FALSE(outlines_touch(north, north, {18.0, 99.0}));
}

TEST(HullOutline, IsNotJumpedOver) {
  const HullOutline a = hull_outline(20.0, 4.0, 0.0), b = hull_outline(10.0, 3.0, 90.0);
  const auto touch = first_touch(a, b, {-1000.0, 0.0}, {1000.0, 0.0});
  ASSERT_TRUE(touch);
  EXPECT_NEAR(*touch, (1000.0 - 7.0) / 2000.0, 1e-12) << "her bow, 5 m, at a side, 2 m";
  EXPECT_FALSE(first_touch(a, b, {-1000.0, 12.0}, {1000.0, 12.0}));
}

// Ways of all sorts past each other.  The reference knows only points within outlines, a tenth
// of a metre apart, at a hundred places of the way.
TEST(HullOutline, AgreesWithPointsWithinPolygons) {
  std::mt19937 random(20261126);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int touched = 0;
  double worst_share = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double length_a = between(4.0, 60.0), length_b = between(4.0, 60.0);
    const double beam_a = length_a * between(0.12, 0.5), beam_b = length_b * between(0.12, 0.5);
    const double heading_a = between(0.0, 360.0), heading_b = between(0.0, 360.0);
    const PlanePoint from{between(-60.0, 60.0), between(-60.0, 60.0)};
    const PlanePoint to{between(-60.0, 60.0), between(-60.0, 60.0)};
    const auto touch = first_touch(hull_outline(length_a, beam_a, heading_a),
                                   hull_outline(length_b, beam_b, heading_b), from, to);
    std::optional<double> exact, larger;
    constexpr int kPlaces = 100;
    for (int k = 0; k <= kPlaces; ++k) {
      const double share = static_cast<double>(k) / kPlaces;
      const PlanePoint way = from + (to - from) * share;
      const auto touches = [&](double more_m) {
        return slow::touch({{}, length_a + more_m, beam_a + more_m, heading_a},
                           {way, length_b + more_m, beam_b + more_m, heading_b}, 0.1);
      };
      // As much larger as the places and the points are apart.
      if (!larger && touches(2.5)) larger = share;
      if (larger && !exact && touches(0.0)) exact = share;
    }
    if (exact) {
      ASSERT_TRUE(touch) << "encounter " << i;
      EXPECT_LE(*touch, *exact + 1e-9) << "encounter " << i;
    }
    if (touch) {
      ++touched;
      ASSERT_TRUE(larger) << "encounter " << i;
      EXPECT_LE(*larger, *touch + 1.0 / kPlaces) << "encounter " << i;
      if (exact) worst_share = std::max(worst_share, *exact - *touch);
    }
  }
  EXPECT_GT(touched, 100);
  EXPECT_LT(touched, 350);
  std::printf("%d of 400 touched; told at most %.3f of the way before the reference\n", touched,
              worst_share);
}

}  // namespace
}  // namespace skerry::server
