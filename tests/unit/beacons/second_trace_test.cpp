#include "echo/beacons/second_trace.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/beacons/far_coast.hpp"
#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::fast_model;
using beacons::kNauticalMile;

PointEcho point_at(double nm, float power = 100.0f) {
  PointEcho point;
  point.range_m = nm * kNauticalMile;
  point.power = power;
  return point;
}

CoastPicture coast_of(std::vector<PlanePoint> vertices) {
  const auto count = static_cast<std::uint32_t>(vertices.size());
  return {LocalPlane(GeoPoint{60.0, 5.0}), {}, 0.0, 200e3, false, std::move(vertices), {0, count}};
}

TEST(SecondTrace, UnambiguousRangesAreThoseOfTheTable) {
  // SOURCES.md "Vectors".
  const double expected[5][2] = {
      {600, 134.90}, {1000, 80.94}, {1800, 44.97}, {3000, 26.98}, {3600, 22.48}};
  for (const auto& [prf, nm] : expected)
    EXPECT_NEAR(unambiguous_range(Pulse{1e-6, 1e6, prf}) / kNauticalMile, nm, 0.005);
}

TEST(SecondTrace, AMountainAtFortyMilesShowsAtThirteen) {
  std::vector<PointEcho> points = {point_at(40.0)};
  points[0].bearing_units = 12345;
  fold_second_trace(fast_model(24.0), points);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].range_m / kNauticalMile, 13.02, 0.005);  // SOURCES.md "Artefacts"
  EXPECT_EQ(points[0].bearing_units, 12345u);
  EXPECT_EQ(points[0].power, 100.0f);
}

TEST(SecondTrace, AThirdTraceIsFoldedTwice) {
  std::vector<PointEcho> points = {point_at(60.0), point_at(85.0)};
  fold_second_trace(fast_model(24.0), points);
  ASSERT_EQ(points.size(), 1u);  // a fourth is not followed
  EXPECT_NEAR(points[0].range_m / kNauticalMile, 60.0 - 2.0 * 26.98, 0.01);
  EXPECT_NEAR(farthest_trace(fast_model(24.0).pulse) / kNauticalMile, 3.0 * 26.98, 0.02);
}

TEST(SecondTrace, LeavesAloneWhatIsInRangeAndTakesOutWhatCannotShow) {
  std::vector<PointEcho> points = {point_at(3.0),         point_at(5.9, 1e-3f), point_at(10.0),
                                   point_at(28.0, 0.01f), point_at(28.0),       point_at(40.0)};
  fold_second_trace(fast_model(6.0), points);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].range_m, 3.0 * kNauticalMile);
  EXPECT_EQ(points[1].range_m, 5.9 * kNauticalMile);
  EXPECT_NEAR(points[2].range_m / kNauticalMile, 28.0 - 26.98, 0.01);
}

TEST(SecondTrace, FoldsWithinTheScaleWhereThatIsTheLonger) {
  std::vector<PointEcho> points = {point_at(20.0), point_at(30.0)};
  fold_second_trace(fast_model(48.0), points);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].range_m, 20.0 * kNauticalMile);
  EXPECT_NEAR(points[1].range_m / kNauticalMile, 30.0 - 26.98, 0.01);
}

TEST(SecondTrace, JitterOfThePrfBreaksItUp) {
  const auto spread = [](double share) {
    double least = 1e9, most = 0.0;
    for (std::uint64_t key = 0; key < 100; ++key) {
      std::vector<PointEcho> points = {point_at(40.0), point_at(5.0)};
      fold_second_trace(fast_model(24.0), points, {share, key});
      EXPECT_EQ(points.at(1).range_m, 5.0 * kNauticalMile);
      least = std::min(least, points[0].range_m), most = std::max(most, points[0].range_m);
    }
    return most - least;
  };
  EXPECT_EQ(spread(0.0), 0.0);
  EXPECT_NEAR(spread(0.02) / kNauticalMile, 0.04 * 26.98, 0.1);
}

TEST(SecondTrace, AStraightCoastBecomesAHyperbola) {
  // 30 NM to the north, running east; folded, y = 30 - r_u bends towards the centre: at bearing b
  // it shows at 30 / cos b - 26.98.
  std::vector<PlanePoint> shore;
  for (int i = -400; i <= 400; ++i) shore.push_back({-1000.0 * i, 30.0 * kNauticalMile});
  const CoastPicture coast = coast_of(std::move(shore));
  const RadarModel model = fast_model(24.0);
  Atmosphere duct;
  duct.ducting = 1.0;
  const Propagation propagation(model.set, duct, 0.0, 200e3);
  std::vector<PointEcho> points;
  far_coast_points(model, propagation, coast, {}, {300.0}, points);
  ASSERT_GT(points.size(), 50u);
  fold_second_trace(model, points);
  double nearest = 1e9;
  std::size_t shown = 0;
  for (const PointEcho& point : points) {
    const double bearing =
        static_cast<std::int32_t>(point.bearing_units) * (2.0 * M_PI / 4294967296.0);
    const double expected =
        30.0 * kNauticalMile / std::cos(bearing) - unambiguous_range(model.pulse);
    if (expected > 23.0 * kNauticalMile) continue;
    // A point stands for half a beam of coast: as far off as its nearest end may be.
    const double slope = 30.0 * kNauticalMile * std::fabs(std::sin(bearing)) /
                         (std::cos(bearing) * std::cos(bearing));
    EXPECT_NEAR(point.range_m, expected, slope * 0.6 * M_PI / 180.0 + 5.0);
    nearest = std::min(nearest, point.range_m);
    ++shown;
  }
  EXPECT_GT(shown, 50u);
  EXPECT_NEAR(nearest / kNauticalMile, 30.0 - 26.98, 0.02);
}

TEST(SecondTrace, NeedsADuctToReachOverTheHorizon) {
  const CoastPicture coast =
      coast_of({{50e3, 60.0 * kNauticalMile}, {-50e3, 60.0 * kNauticalMile}});
  const RadarModel model = fast_model(24.0);
  const auto found = [&](double ducting) {
    Atmosphere air;
    air.ducting = ducting;
    std::vector<PointEcho> points;
    far_coast_points(model, Propagation(model.set, air, 0.0, 200e3), coast, {}, {100.0}, points);
    return points.size();
  };
  EXPECT_EQ(found(0.0), 0u);
  EXPECT_GT(found(1.0), 20u);
}

TEST(SecondTrace, TakesTheNearestShoreOfEachBearing) {
  const CoastPicture coast =
      coast_of({{40e3, 60e3}, {-40e3, 60e3}, {-40e3, 70e3}, {40e3, 70e3}, {40e3, 60e3}});
  const RadarModel model = fast_model(24.0);
  Atmosphere duct;
  duct.ducting = 1.0;
  std::vector<PointEcho> points;
  far_coast_points(model, Propagation(model.set, duct, 0.0, 200e3), coast, {}, {200.0}, points);
  ASSERT_GT(points.size(), 20u);
  for (const PointEcho& point : points) {
    const double bearing =
        static_cast<std::int32_t>(point.bearing_units) * (2.0 * M_PI / 4294967296.0);
    EXPECT_LT(point.range_m * std::cos(bearing), 61e3);
  }
}

}  // namespace
}  // namespace skerry::echo
