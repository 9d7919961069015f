#include "echo/returns/coast_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

std::vector<LandInterval> land(std::vector<Crossing> crossings, bool ashore, double range = 100.0) {
  std::vector<LandInterval> out;
  land_along(crossings, ashore, range, out);
  return out;
}

TEST(LandAlong, OpenSeaHasNoLandAndInlandHasNothingElse) {
  EXPECT_TRUE(land({}, false).empty());
  ASSERT_EQ(land({}, true).size(), 1u);
  EXPECT_EQ(land({}, true)[0].end_m, 100.0);
}

TEST(LandAlong, AnIslandIsOneStretch) {
  const auto l = land({{20, true}, {30, false}}, false);
  ASSERT_EQ(l.size(), 1u);
  EXPECT_EQ(l[0].begin_m, 20.0);
  EXPECT_EQ(l[0].end_m, 30.0);
}

TEST(LandAlong, ALakeOnAnIslandIsAGap) {
  const auto l = land({{20, true}, {25, false}, {28, true}, {40, false}}, false);
  ASSERT_EQ(l.size(), 2u);
  EXPECT_EQ(l[1].begin_m, 28.0);
}

TEST(LandAlong, ARayThatLeavesLandFirstBeganOnIt) {
  const auto l = land({{15, false}}, false);  // whatever the picture's centre is
  ASSERT_EQ(l.size(), 1u);
  EXPECT_EQ(l[0].begin_m, 0.0);
  EXPECT_EQ(l[0].end_m, 15.0);
}

TEST(LandAlong, OverlappingLandIsOneStretch) {
  const auto l = land({{10, true}, {20, true}, {30, false}, {50, false}}, false);
  ASSERT_EQ(l.size(), 1u);
  EXPECT_EQ(l[0].end_m, 50.0);
}

// The far shore of an island whose near shore lies beyond the picture says nothing.
TEST(LandAlong, CrossingsBeyondTheRangeDoNotCount) {
  EXPECT_TRUE(land({{160, false}}, false).empty());
  EXPECT_EQ(land({{20, true}, {30, false}, {160, false}}, false).size(), 1u);
}

TEST(LandAlong, OppositeCrossingsAtOnePlaceCancel) {
  EXPECT_TRUE(land({{20, false}, {20, true}}, false).empty());
  EXPECT_TRUE(land({{20, false}, {20 + 1e-9, true}}, false).empty());
}

TEST(LandAlong, CrossingsOnTheSpotDoNotCount) {
  EXPECT_TRUE(land({{0, true}}, false).empty());
  EXPECT_EQ(land({{0, false}, {30, false}}, false)[0].end_m, 30.0);
}

TEST(LandAlong, LandEndsAtTheRangeScale) {
  EXPECT_EQ(land({{60, true}, {160, false}}, false)[0].end_m, 100.0);
  EXPECT_TRUE(land({{160, true}, {190, false}}, false).empty());
}

// A ray through each vertex of a ring, from inside and outside, crosses it as often as its
// neighbours do: the half-open rule.
TEST(FindCrossings, ThroughAVertexMeetsOneEdge) {
  CoastPicture coast{LocalPlane({0, 0}),
                     {},
                     0,
                     1e4,
                     false,
                     {{-100, 200}, {100, 200}, {150, 300}, {0, 400}, {-100, 200}},
                     {0, 5}};
  const PolarIndex index(coast, {0, 0}, 1.0);
  std::vector<Crossing> crossings;
  for (const PlanePoint& v : coast.vertices) {
    const double bearing = std::atan2(v.east_m, v.north_m);
    const auto units =
        static_cast<std::uint32_t>(static_cast<std::int64_t>(bearing * 683565275.5764316));
    for (std::uint32_t d : {0u, 1u, ~0u}) {
      find_crossings(coast, index, {{0, 0}, units + d}, crossings);
      EXPECT_EQ(crossings.size() % 2, 0u);
    }
  }
  // Due north exactly through the vertex at (0, 400).
  find_crossings(coast, index, {{0, 0}, 0}, crossings);
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_DOUBLE_EQ(crossings[0].range_m, 200.0);
  EXPECT_TRUE(crossings[0].into_land);
  EXPECT_DOUBLE_EQ(crossings[1].range_m, 400.0);
  EXPECT_FALSE(crossings[1].into_land);
}

TEST(FindCrossings, OnAVertexAndOnAnEdgeTheOwnShipSeesFiniteRanges) {
  CoastPicture coast{LocalPlane({0, 0}),
                     {},
                     0,
                     1e4,
                     false,
                     {{-100, 200}, {100, 200}, {150, 300}, {0, 400}, {-100, 200}},
                     {0, 5}};
  std::vector<Crossing> crossings;
  for (const PlanePoint own : {PlanePoint{-100, 200}, PlanePoint{0, 200}, PlanePoint{10, 300}}) {
    const PolarIndex index(coast, own, 1.0);
    for (std::uint32_t k = 0; k < 4096; ++k) {
      find_crossings(coast, index, {own, k << 20}, crossings);
      EXPECT_LE(crossings.size(), 4u);
      for (const Crossing& c : crossings) {
        EXPECT_TRUE(std::isfinite(c.range_m));
        EXPECT_LT(c.range_m, 400.0);
      }
    }
  }
}

}  // namespace
}  // namespace skerry::echo
