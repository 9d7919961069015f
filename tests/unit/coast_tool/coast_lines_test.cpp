#include "echo/coast_tool/coast_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/coast_tool/coast_stretches.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

const CoastArea kArea{"test", -1.0, 1.0, -1.0, 1.0};
const LocalPlane kPlane{{0.0, 0.0}};

// A ring of places in hundredths of a degree, each known by its place.
CoastRing ring_of(const std::vector<std::pair<int, int>>& places) {
  CoastRing ring;
  for (auto [lat, lon] : places) {
    ring.vertices.push_back({lat / 100.0, lon / 100.0});
    ring.vertex_ids.push_back(static_cast<std::uint64_t>((lat + 1000) * 10000 + lon + 1000));
    ring.edges.push_back(EdgeKind::shoreline);
  }
  return ring;
}

TEST(CoastLines, AnIslandIsOneClosedLine) {
  CoastChart chart;
  chart.rings = {ring_of({{0, 0}, {0, 10}, {10, 10}, {10, 0}})};
  const CoastLines coast = coast_lines(chart, kPlane, kArea);
  ASSERT_EQ(coast.lines.size(), 1u);
  EXPECT_EQ(coast.lines[0].size(), 5u);
  EXPECT_EQ(coast.lines[0].front(), coast.lines[0].back());
  EXPECT_EQ(coast.edges, 4u);
  EXPECT_NEAR(coast.length_m, 4 * 11100.0, 200.0);
  EXPECT_NEAR(coast.mean_spacing_m, coast.length_m / 4.0, 1e-6);
}

// Two bins with a border between them at longitude 0: the coast runs on from one to the other.
TEST(CoastLines, RunOnAcrossTheBordersOfBins) {
  CoastRing west = ring_of({{0, 0}, {10, 0}, {12, -5}, {10, -20}, {0, -20}});
  west.edges = {EdgeKind::bin_border, EdgeKind::shoreline, EdgeKind::shoreline, EdgeKind::shoreline,
                EdgeKind::bin_border};
  CoastRing east = ring_of({{0, 20}, {10, 20}, {12, 5}, {10, 0}, {0, 0}});
  east.edges = {EdgeKind::bin_border, EdgeKind::shoreline, EdgeKind::shoreline,
                EdgeKind::bin_border, EdgeKind::bin_border};
  CoastChart chart;
  for (bool west_first : {true, false}) {
    chart.rings = west_first ? std::vector{west, east} : std::vector{east, west};
    const CoastLines coast = coast_lines(chart, kPlane, kArea);
    ASSERT_EQ(coast.lines.size(), 1u);
    ASSERT_EQ(coast.lines[0].size(), 6u);
    EXPECT_NEAR(coast.lines[0].front().east_m, 0.2 * 111320.0, 20.0);  // land on the left
    EXPECT_NEAR(coast.lines[0].back().east_m, -0.2 * 111320.0, 20.0);
    EXPECT_EQ(coast.edges, 5u);
  }
}

TEST(CoastLines, AreCutAtTheAreaAndNotWhereTheRingBegins) {
  // The ring begins in the middle of its part inside the area.
  CoastChart chart;
  chart.rings = {
      ring_of({{0, 0}, {0, 80}, {0, 160}, {200, 160}, {200, -160}, {0, -160}, {0, -80}})};
  const CoastLines coast = coast_lines(chart, kPlane, kArea);
  ASSERT_EQ(coast.lines.size(), 1u);
  EXPECT_EQ(coast.lines[0].size(), 3u);  // edges to 160 have their middle outside
}

TEST(CoastLines, OfOneTypeOnly) {
  CoastChart chart;
  chart.rings = {ring_of({{0, 0}, {0, 10}, {10, 10}, {10, 0}})};
  chart.shores = {{}, {.type = CoastType::artificial}};
  chart.rings[0].shores = {0, 1, 1, 0};
  EXPECT_EQ(coast_lines(chart, kPlane, kArea, CoastType::artificial).edges, 2u);
  EXPECT_EQ(coast_lines(chart, kPlane, kArea, CoastType::unknown).lines.size(), 1u);
  EXPECT_EQ(coast_lines(chart, kPlane, kArea, CoastType::rocky).edges, 0u);
  EXPECT_EQ(coast_lines(chart, kPlane, kArea).edges, 4u);
}

TEST(CoastLines, WithoutCoastAreEmpty) {
  const CoastLines coast = coast_lines({}, kPlane, kArea);
  EXPECT_TRUE(coast.lines.empty());
  EXPECT_EQ(coast.mean_spacing_m, 0.0);
}

TEST(CoastLines, AStretchIsCutOutToTheMetre) {
  const PlaneLine line = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}};
  const PlaneLine stretch = stretch_of(line, 50.0, 250.0);
  EXPECT_EQ(stretch, (PlaneLine{{50.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {50.0, 100.0}}));
  EXPECT_NEAR(length_of(stretch), 200.0, 1e-9);
  EXPECT_NEAR(length_of(stretch_of(line, 0.0, 1000.0)), 300.0, 1e-9);
  EXPECT_TRUE(stretch_of(line, 400.0, 500.0).empty());
}

TEST(CoastStretches, AreEqualPartsOfEachLine) {
  CoastLines coast;
  coast.lines = {PlaneLine{}, PlaneLine{{0.0, 5000.0}, {3000.0, 5000.0}}};
  for (int i = 0; i <= 236; ++i) coast.lines[0].push_back({100.0 * i, (i & 1) ? 30.0 : 0.0});
  coast.mean_spacing_m = 104.0;
  const CoastStretches found =
      measure_stretches(coast, kPlane, 10000.0, 100.0, [](const std::string&) {});
  ASSERT_EQ(found.stretches.size(), 2u);  // 24.6 km
  EXPECT_EQ(found.left_out, 1u);
  EXPECT_NEAR(found.left_out_m, 3000.0, 1e-6);
  for (const CoastStretch& s : found.stretches) {
    EXPECT_NEAR(s.length_m, 236 * std::hypot(100.0, 30.0) / 2.0, 1e-6);
    EXPECT_NEAR(s.radius_m, 5900.0, 20.0);
    EXPECT_NEAR(s.middle.latitude_deg, 0.0, 0.001);
  }
  EXPECT_NEAR(found.stretches[1].middle.longitude_deg, 3.0 * 5900.0 / 111320.0, 0.001);
}

}  // namespace
}  // namespace skerry::echo
