#include "echo/returns/shore_stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/returns/land_returns.hpp"

namespace skerry::echo {
namespace {

constexpr double kCell = 5.0, kRange = 10000.0;

// Shores: 1 sandy, 2 rocky, 3 artificial, 4 seam.
CoastPicture picture() {
  CoastPicture coast{LocalPlane({60, 5}), {}, 0, 2e4, false, {{-1e4, 1000}, {1e4, 1000}}, {0, 2}};
  coast.shores = {{},
                  {CoastType::sandy, false, 0.0f},
                  {CoastType::rocky, false, 0.0f},
                  {CoastType::artificial, false, 0.0f},
                  {CoastType::unknown, true, 0.0f}};
  return coast;
}

std::vector<ShoreStretch> lay(std::vector<LandInterval> land, ShoreWater water = {},
                              double range = kRange) {
  std::vector<ShoreStretch> out;
  lay_shores(land, picture(), {{0, 0}, 0}, 0.0015, kCell, range, water,
             lattice_path({60, 5}, {}, 0, kCell), out);
  return out;
}

TEST(ShoreStretch, SandMovesByTheLevelOverItsSlope) {
  for (const double level : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
    const auto s = lay({{2000, 4000, 1, 1}}, {level, 0.0, 0.0, 9});
    ASSERT_EQ(s.size(), 1u);
    EXPECT_NEAR(s[0].begin_m, 2000 + 50.0 * level, 1e-9);
    EXPECT_NEAR(s[0].end_m, 4000 - 50.0 * level, 1e-9);
    EXPECT_NEAR(s[0].begin.state.foreshore_m, -50.0 * level, 1e-9);
  }
}

TEST(ShoreStretch, OnlySandMoves) {
  for (const std::uint8_t shore : std::vector<std::uint8_t>{0, 2, 3, 4}) {
    const auto s = lay({{2000, 4000, shore, shore}}, {-3.0, 2.0, 17.0, 9});
    EXPECT_EQ(s[0].begin_m, 2000.0) << int{shore};
    EXPECT_EQ(s[0].end_m, 4000.0) << int{shore};
  }
  const auto mixed = lay({{2000, 4000, 2, 1}}, {-3.0, 0.0, 0.0, 9});
  EXPECT_EQ(mixed[0].begin_m, 2000.0);
  EXPECT_NEAR(mixed[0].end_m, 4150.0, 1e-9);
}

TEST(ShoreStretch, SandSwallowsNeitherItsLandNorTheWater) {
  const std::vector<LandInterval> strait = {
      {1000, 1100, 1, 1}, {1130, 1160, 1, 1}, {1161, 9990, 1, 0}, {9995, kRange, 1, 0}};
  for (double level = -15.0; level <= 15.0; level += 0.25) {
    for (const double waves : {0.0, 3.0, 15.0}) {
      const auto s = lay(strait, {level, waves, 3.0, 9});
      double water_from = 0.0;
      for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_GT(s[i].begin_m, water_from) << level << ", stretch " << i;
        EXPECT_GT(s[i].end_m, s[i].begin_m) << level << ", stretch " << i;
        water_from = s[i].end_m;
      }
      EXPECT_LE(s.back().end_m, kRange);
    }
  }
}

TEST(ShoreStretch, WavesMoveTheEdgeOfSandToAndFroWithinTheSwash) {
  const double swash = swash_m(1.5);
  EXPECT_NEAR(swash, 4.33, 0.01);  // half of sqrt(1.5 m * 50 m)
  double least = 1e9, most = -1e9;
  for (double t = 0.0; t < 200.0; t += 0.5) {
    const double off = lay({{2000, 4000, 1, 1}}, {0.0, 1.5, t, 9})[0].begin_m - 2000.0;
    least = std::min(least, off), most = std::max(most, off);
    EXPECT_LE(std::fabs(off), swash);
  }
  EXPECT_LT(least, -0.5 * swash);
  EXPECT_GT(most, 0.5 * swash);
}

// Correlated over a second or so and tens of metres, and not beyond.
TEST(ShoreStretch, BeachNoiseIsForgottenInSecondsAndTensOfMetres) {
  const LatticePath path = lattice_path({60, 5}, {}, 0x10000000u, kCell);
  constexpr int kTimes = 400, kCells = 200;
  const auto correlation = [&](double dt, int cells) {
    double xx = 0.0, xy = 0.0;
    std::vector<float> a(kCells), b(kCells);
    for (int i = 0; i < kTimes; ++i) {
      const double t = 0.37 * i;
      beach_noise({0.0, 1.0, t, 5}, path, 300, a);
      beach_noise({0.0, 1.0, t + dt, 5}, path, 300u + static_cast<std::uint32_t>(cells), b);
      for (std::size_t k = 0; k < kCells; ++k) {
        EXPECT_LE(std::fabs(a[k]), 1.0f);
        xx += static_cast<double>(a[k]) * static_cast<double>(a[k]);
        xy += static_cast<double>(a[k]) * static_cast<double>(b[k]);
      }
    }
    return xy / xx;
  };
  std::printf(
      "beach noise: %.2f after 0.3 s, %.2f after 1.5 s, %.3f after 4 s; %.2f at 10 m, "
      "%.3f at 100 m\n",
      correlation(0.3, 0), correlation(1.5, 0), correlation(4.0, 0), correlation(0.0, 2),
      correlation(0.0, 20));
  EXPECT_NEAR(correlation(0.0, 0), 1.0, 1e-6);
  EXPECT_GT(correlation(0.3, 0), 0.8);
  EXPECT_NEAR(correlation(4.0, 0), 0.0, 0.1);
  EXPECT_GT(correlation(0.0, 2), 0.7);
  EXPECT_NEAR(correlation(0.0, 20), 0.0, 0.1);
}

TEST(ShoreStretch, OfASeamTheOtherShoreRules) {
  const auto s = lay({{2000, 4000, 1, 4}});
  EXPECT_FALSE(s[0].begin.open);
  EXPECT_TRUE(s[0].end.open);
}

TEST(ShoreStretch, AcrossASeamDistancesInlandGoOn) {
  const auto s = lay({{2000, 4000, 2, 4}, {4003, 5000, 4, 4}, {5020, 7000, 4, 2}});
  ASSERT_EQ(s.size(), 3u);
  for (const ShoreStretch& part : s) {
    EXPECT_EQ(part.begin.at_m, 2000.0);
    EXPECT_EQ(part.end.at_m, 7000.0);
    EXPECT_FALSE(part.begin.open || part.end.open);
  }
  EXPECT_EQ(s[1].begin_m, 4003.0);
  EXPECT_EQ(s[1].end_m, 5000.0);
  const auto apart = lay({{2000, 4000, 2, 4}, {4100, 5000, 4, 2}});
  EXPECT_TRUE(apart[0].end.open && apart[1].begin.open);
}

TEST(ShoreStretch, LandInSightOfNoShoreIsOpen) {
  const auto s = lay({{0, 500, 0, 1}, {9000, kRange, 1, 0}});
  EXPECT_TRUE(s[0].begin.open);
  EXPECT_TRUE(s[1].end.open);
  EXPECT_FALSE(s[0].end.open || s[1].begin.open);
}

// A quay of 60 m that runs away from the ship at a slant of 1 in 100, and one square to the ray.
TEST(ShoreStretch, TheFaceOfAQuayAlongTheRayReachesOverItsLengthWithinTheArc) {
  CoastPicture coast = picture();
  const auto face = [&](PlanePoint from, PlanePoint to, double at) {
    coast.vertices = {from, to};
    std::vector<ShoreStretch> out;
    lay_shores({{at, 4000, 3, 3, 0}}, coast, {{0, 0}, 0}, 0.0015, kCell, kRange, {},
               lattice_path({60, 5}, {}, 0, kCell), out);
    return std::pair{out[0].face_near_m, out[0].face_far_m};
  };
  // The ray's arc at 2 km is 3 m: 300 m of slant, cut off at the quay's ends.
  const auto along = face({0.3, 2030}, {-0.3, 1970}, 2000);
  EXPECT_NEAR(along.first, 30.0, 1e-9);
  EXPECT_NEAR(along.second, 30.0, 1e-9);
  // 1 in 10 over 100 m: 15 m to either side of the crossing.
  const auto slanting = face({5, 2050}, {-5, 1950}, 2000);
  EXPECT_NEAR(slanting.first, 15.0, 1e-9);
  EXPECT_NEAR(slanting.second, 15.0, 1e-9);
  const auto square = face({50, 2000}, {-50, 2000}, 2000);
  EXPECT_EQ(square.first, 0.0);
  EXPECT_EQ(square.second, 0.0);
}

}  // namespace
}  // namespace skerry::echo
