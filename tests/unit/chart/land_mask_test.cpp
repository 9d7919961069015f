#include "echo/chart/land_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

namespace skerry::echo {
namespace {

CoastChart chart_of(std::initializer_list<std::vector<GeoPoint>> rings) {
  CoastChart chart;
  for (const auto& vertices : rings) {
    CoastRing ring;
    ring.vertices = vertices;
    for (GeoPoint& v : ring.vertices) v.longitude_deg = wrapped_longitude(v.longitude_deg);
    chart.rings.push_back(std::move(ring));
  }
  return chart;
}

std::vector<GeoPoint> box(double south, double west, double north, double east) {
  return {{south, west}, {south, east}, {north, east}, {north, west}};
}
std::vector<GeoPoint> reversed(std::vector<GeoPoint> ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(LandMask, LandWithALakeWithAnIsland) {
  const CoastChart chart =
      chart_of({box(0, 0, 10, 10), reversed(box(2, 2, 8, 8)), box(4, 4, 6, 6)});
  EXPECT_TRUE(is_land(chart, {1, 1}));
  EXPECT_FALSE(is_land(chart, {3, 3}));
  EXPECT_TRUE(is_land(chart, {5, 5}));
  EXPECT_FALSE(is_land(chart, {5, 11}));
  EXPECT_FALSE(is_land(chart, {-1, 5}));
  EXPECT_FALSE(is_land(chart, {11, 5}));
  EXPECT_FALSE(is_land(chart, {5, -175}));  // the opposite meridian
}

TEST(LandMask, AcrossTheAntimeridian) {
  const CoastChart chart = chart_of({box(-17, 179.5, -16, 180.5)});
  for (const double longitude : {179.6, 180.0, -180.0, 180.4, -179.6})
    EXPECT_TRUE(is_land(chart, {-16.5, longitude})) << longitude;
  for (const double longitude : {179.4, -179.4, 0.0, 0.4})
    EXPECT_FALSE(is_land(chart, {-16.5, longitude})) << longitude;
}

TEST(LandMask, AroundAPole) {
  std::vector<GeoPoint> parallel;
  for (int longitude = -180; longitude < 180; longitude += 40)
    parallel.push_back({70.0, 1.0 * longitude});
  std::vector<GeoPoint> south = parallel, lake = parallel;
  for (GeoPoint& v : south) v.latitude_deg = -75.0;
  for (GeoPoint& v : lake) v.latitude_deg = 85.0;
  // Land is on the left: north of a ring that runs east, south of one that runs west.
  CoastChart chart = chart_of({parallel, reversed(south), reversed(lake)});
  chart.rings[2].level = 2;
  for (const double longitude : {-180.0, -100.0, 0.0, 13.0, 179.9}) {
    EXPECT_EQ(winding_number(chart, {75.0, longitude}), 1) << longitude;
    EXPECT_EQ(winding_number(chart, {88.0, longitude}), 0) << longitude << ", in the lake";
    EXPECT_EQ(winding_number(chart, {0.0, longitude}), 0) << longitude;
    EXPECT_EQ(winding_number(chart, {-80.0, longitude}), 1) << longitude;
  }
}

TEST(LandMask, ExactlyBelowAVertexIsCountedOnce) {
  const CoastChart chart = chart_of({{{5, 0}, {0, 1}, {5, 2}, {10, 1}}});
  EXPECT_TRUE(is_land(chart, {5, 1}));    // below the northern vertex
  EXPECT_FALSE(is_land(chart, {-1, 1}));  // below both
  EXPECT_FALSE(is_land(chart, {-1, 0}));
  EXPECT_FALSE(is_land(chart, {-1, 2}));
  EXPECT_FALSE(is_land(chart, {11, 1}));
}

TEST(LandMask, BinsSideBySideHaveNoGapAndNoOverlap) {
  const CoastChart chart =
      chart_of({box(0, 0, 1, 1), box(0, 1, 1, 2), box(1, 0, 2, 1), box(1, 1, 2, 2)});
  for (const GeoPoint p : {GeoPoint{1, 1}, GeoPoint{1, 0.5}, GeoPoint{0.5, 1}, GeoPoint{1, 1.5},
                           GeoPoint{1.5, 1}, GeoPoint{0, 1}})
    EXPECT_EQ(winding_number(chart, p), 1) << p.latitude_deg << ", " << p.longitude_deg;
}

TEST(LandMask, ThePolesOfACapOfBins) {
  CoastChart chart;
  for (double west = -180; west < 180; west += 20)
    chart.rings.push_back(chart_of({box(-90, west, -70, west + 20)}).rings[0]);
  for (double longitude = -180; longitude < 180; longitude += 2.5) {
    EXPECT_EQ(winding_number(chart, {-90, longitude}), 1) << longitude;
    EXPECT_EQ(winding_number(chart, {-75, longitude}), 1) << longitude;
    EXPECT_EQ(winding_number(chart, {-69, longitude}), 0) << longitude;
  }
}

TEST(LandMask, WhereIslandsOverlapIsLand) {
  const CoastChart chart = chart_of({box(0, 0, 4, 4), box(2, 2, 6, 6)});
  EXPECT_EQ(winding_number(chart, {3, 3}), 2);
  EXPECT_TRUE(is_land(chart, {3, 3}));
}

TEST(LandMask, AnEmptyChartIsSea) {
  EXPECT_FALSE(is_land(CoastChart{}, {0, 0}));
  EXPECT_FALSE(is_land(chart_of({{}}), {0, 0}));
}

}  // namespace
}  // namespace skerry::echo
