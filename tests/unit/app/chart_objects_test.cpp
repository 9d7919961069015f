// The chart as consoles draw it.
#include "server/app/chart_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "server/app/chart_lines.hpp"

namespace skerry::server {
namespace {

wire::GetChartObjects asked_about(double latitude_deg, double longitude_deg, double radius_nm,
                                  double tolerance_m = 0.0) {
  wire::GetChartObjects place;
  place.set_latitude_deg(latitude_deg);
  place.set_longitude_deg(longitude_deg);
  place.set_radius_nm(radius_nm);
  place.set_tolerance_m(tolerance_m);
  return place;
}

echo::CoastRing shore_ring(std::vector<GeoPoint> vertices) {
  echo::CoastRing ring;
  ring.edges.assign(vertices.size(), echo::EdgeKind::shoreline);
  ring.vertices = std::move(vertices);
  return ring;
}

std::vector<GeoPoint> places_of(const wire::ChartObjects& chart, int line) {
  std::vector<GeoPoint> points;
  std::int64_t east = 0, north = 0;
  const auto& told = chart.lines(line).points();
  for (int i = 0; i + 1 < told.size(); i += 2) {
    east += told[i];
    north += told[i + 1];
    points.push_back({chart.latitude_deg() + 1e-6 * static_cast<double>(north),
                      wrapped_longitude(chart.longitude_deg() + 1e-6 * static_cast<double>(east))});
  }
  return points;
}

TEST(ChartLines, AreCutWhereTheyLeaveTheSquareAndComeBack) {
  const std::vector<PlanePoint> line = {{-300, 0}, {0, 0}, {300, 50}, {300, -50}, {0, 20}};
  const auto parts = parts_within(line, 100.0);
  ASSERT_EQ(parts.size(), 2u);
  ASSERT_EQ(parts[0].size(), 3u);
  EXPECT_EQ(parts[0].front(), (PlanePoint{-100, 0}));
  EXPECT_EQ(parts[0][1], (PlanePoint{0, 0}));
  EXPECT_NEAR(parts[0].back().east_m, 100.0, 1e-9);
  EXPECT_NEAR(parts[0].back().north_m, 50.0 / 3.0, 1e-9);
  EXPECT_EQ(parts[1].back(), (PlanePoint{0, 20}));
  EXPECT_TRUE(parts_within({{200, 200}, {300, 300}}, 100.0).empty());
  EXPECT_TRUE(parts_within({}, 100.0).empty());
  EXPECT_TRUE(parts_within({{0, 0}}, 100.0).empty());
}

double distance_to(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint way = b - a;
  const double along = std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0);
  return length_of(p - (a + way * along));
}

TEST(ChartLines, WhatIsLeftOfALineIsWithinTheTolerance) {
  std::mt19937 random(5);
  std::normal_distribution<double> step(0.0, 30.0);
  std::vector<PlanePoint> line = {{0, 0}};
  for (int i = 0; i < 3000; ++i)
    line.push_back(line.back() + PlanePoint{10.0 + step(random), step(random)});
  const std::vector<float> counts = significance(line);
  EXPECT_EQ(counts.front(), std::numeric_limits<float>::infinity());
  EXPECT_EQ(counts.back(), std::numeric_limits<float>::infinity());
  std::size_t before = line.size() + 1;
  for (const double tolerance_m : {1.0, 10.0, 100.0, 1000.0}) {
    double worst = 0.0;
    std::size_t kept = 1, last = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (!(static_cast<double>(counts[i]) > tolerance_m)) continue;
      for (std::size_t k = last; k <= i; ++k)
        worst = std::max(worst, distance_to(line[k], line[last], line[i]));
      last = i;
      ++kept;
    }
    EXPECT_LE(worst, tolerance_m * 1.0001);
    EXPECT_LT(kept, before) << tolerance_m;
    before = kept;
  }
}

// How often distances are worked out for a line, per vertex.
double looks_per_vertex(const std::vector<PlanePoint>& line) {
  std::size_t looks = 0;
  significance(line, &looks);
  return static_cast<double>(looks) / static_cast<double>(line.size());
}

TEST(ChartLines, OfALineThatIsStraightOnlyTheEndsCount) {
  constexpr int kPoints = 100'000;
  const std::vector<PlanePoint> repeated(kPoints, PlanePoint{10.0, 20.0});
  std::vector<PlanePoint> straight;
  for (int i = 0; i < kPoints; ++i) straight.push_back({0.1 * i, 0.3 * i + 0.02 * (i % 2)});
  for (const auto& line : {repeated, straight}) {
    const std::vector<float> counts = significance(line);
    EXPECT_TRUE(std::isinf(counts.front()) && std::isinf(counts.back()));
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 0.0f), kPoints - 2);
    EXPECT_LE(looks_per_vertex(line), 1.0);
  }
}

TEST(ChartLines, NoLineTakesTheSquareOfItsVertices) {
  constexpr int kPoints = 100'000;
  std::vector<PlanePoint> comb, there_and_back, spiral;
  for (int i = 0; i < kPoints; ++i) {
    comb.push_back({1.0 * i, 10.0 * (i % 2)});  // half of the vertices are as far as each other
    there_and_back.push_back({i % 2 == 0 ? 0.0 : 500.0, 0.0});
    // Each split takes a vertex off one end.
    const double turn = 2.5 * i;
    spiral.push_back(PlanePoint{std::sin(turn), std::cos(turn)} * (1e6 - 10.0 * i));
  }
  EXPECT_LE(looks_per_vertex(comb), 40.0) << "ties are split in the middle";
  EXPECT_LE(looks_per_vertex(there_and_back), 100.0);
  EXPECT_LE(looks_per_vertex(spiral), 100.0);
}

TEST(ChartObjects, HaveTheShoreAndNeitherSeamsNorBordersOfBins) {
  echo::CoastChart coast;
  coast.source = "made up";
  coast.rings = {shore_ring({{60.0, 5.0}, {60.0, 5.02}, {60.02, 5.02}, {60.02, 5.0}})};
  coast.rings[0].edges[1] = echo::EdgeKind::bin_border;
  coast.rings[0].edges[3] = echo::EdgeKind::seam;
  const wire::ChartObjects chart = chart_objects_of(coast, {}, asked_about(60.01, 5.01, 10.0));
  EXPECT_EQ(chart.chart(), "made up");
  EXPECT_TRUE(chart.coast_only());
  ASSERT_EQ(chart.lines_size(), 2);
  std::vector<double> north;
  for (int line = 0; line < 2; ++line) {
    EXPECT_EQ(chart.lines(line).kind(), wire::ChartLine::COAST);
    const std::vector<GeoPoint> points = places_of(chart, line);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0].latitude_deg, points[1].latitude_deg, 1e-6) << "east and west are none";
    north.push_back(points[0].latitude_deg);
  }
  std::sort(north.begin(), north.end());
  EXPECT_NEAR(north[0], 60.0, 1e-6);
  EXPECT_NEAR(north[1], 60.02, 1e-6);
}

TEST(ChartObjects, AnIslandIsALineThatEndsWhereItBegan) {
  echo::CoastChart coast;
  // Across the date line.
  coast.rings = {shore_ring({{60.0, 179.99}, {60.0, -179.99}, {60.01, 180.0 - 360.0}})};
  const wire::ChartObjects chart = chart_objects_of(coast, {}, asked_about(60.0, 179.999, 10.0));
  ASSERT_EQ(chart.lines_size(), 1);
  const std::vector<GeoPoint> points = places_of(chart, 0);
  ASSERT_EQ(points.size(), 4u);
  EXPECT_NEAR(points[0].longitude_deg, 179.99, 1e-6);
  EXPECT_NEAR(points[1].longitude_deg, -179.99, 1e-6);
  EXPECT_NEAR(points[3].longitude_deg, 179.99, 1e-6);
  // One that is smaller than the tolerance is left out.
  EXPECT_EQ(chart_objects_of(coast, {}, asked_about(60.0, 179.999, 10.0, 2000.0)).lines_size(), 0);
}

TEST(ChartObjects, ALineOnTheOtherSideOfTheEarthDoesNotCrossThePicture) {
  echo::CoastChart coast;
  coast.rings = {shore_ring({{10.0, 179.0}, {10.0, -179.0}, {-10.0, 179.0}})};
  EXPECT_EQ(chart_objects_of(coast, {}, asked_about(10.0, 0.0, 60.0)).lines_size(), 0);
}

TEST(ChartObjects, MarksStandToADecimetreTheNearestFirst) {
  echo::ChartDetail detail;
  detail.is_charted = true;
  detail.contours = {{5.0f, {{47.25, -122.45}, {47.26, -122.44}}}};
  echo::ChartMark far, near, beyond;
  far.kind = echo::MarkKind::wreck;
  far.place = {47.3, -122.5};
  far.depth_m = 4.2f;
  near.kind = echo::MarkKind::lateral_starboard;
  near.place = {47.2781234, -122.4167654};
  near.name = std::string(200, 'x');
  near.colours = {3, 1};
  near.light = "Fl R 4s";
  beyond.place = {48.5, -122.45};
  detail.marks = {far, near, beyond};
  const wire::ChartObjects chart = chart_objects_of({}, detail, asked_about(47.28, -122.42, 10.0));
  EXPECT_FALSE(chart.coast_only());
  ASSERT_EQ(chart.lines_size(), 1);
  EXPECT_EQ(chart.lines(0).kind(), wire::ChartLine::DEPTH_CONTOUR);
  EXPECT_EQ(chart.lines(0).depth_m(), 5.0);
  ASSERT_EQ(chart.marks_size(), 2);
  const wire::ChartMark& first = chart.marks(0);
  EXPECT_EQ(first.kind(), wire::ChartMark::LATERAL_STARBOARD);
  EXPECT_NEAR(chart.latitude_deg() + 1e-6 * first.latitude(), near.place.latitude_deg, 6e-7);
  EXPECT_NEAR(chart.longitude_deg() + 1e-6 * first.longitude(), near.place.longitude_deg, 6e-7);
  EXPECT_EQ(first.name().size(), 64u);
  EXPECT_EQ(first.light(), "Fl R 4s");
  ASSERT_EQ(first.colours_size(), 2);
  EXPECT_FALSE(first.has_depth_m());
  EXPECT_EQ(chart.marks(1).kind(), wire::ChartMark::WRECK);
  EXPECT_NEAR(chart.marks(1).depth_m(), 4.2, 1e-6);
  EXPECT_EQ(chart.marks_left_out(), 0u);
}

// Kinds go over the wire by their numbers.
static_assert(static_cast<int>(echo::MarkKind::cardinal_west) == wire::ChartMark::CARDINAL_WEST);
static_assert(static_cast<int>(echo::MarkKind::light) == wire::ChartMark::LIGHT);
static_assert(static_cast<int>(echo::MarkKind::rock) == wire::ChartMark::ROCK);
static_assert(static_cast<int>(echo::MarkKind::light_vessel) == wire::ChartMark::LIGHT_VESSEL);

TEST(ChartObjects, AreNeverLongerThanAllowed) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> jitter(-0.001, 0.001);
  echo::ChartDetail detail;
  for (int i = 0; i < 40; ++i) {
    echo::DepthContour contour{10.0f, {}};
    for (int k = 0; k < 5000; ++k)
      contour.line.push_back({59.9 + 0.005 * i + jitter(random), 4.8 + 8e-5 * k + jitter(random)});
    detail.contours.push_back(std::move(contour));
  }
  for (int i = 0; i < 9000; ++i) {
    echo::ChartMark mark;
    mark.place = {60.0 + 1e-5 * i, 5.0};
    mark.name = "a name of some length " + std::to_string(i);
    detail.marks.push_back(mark);
  }
  const wire::ChartObjects chart = chart_objects_of({}, detail, asked_about(60.0, 5.0, 10.0));
  EXPECT_LE(chart.ByteSizeLong(), kMostChartBytes);
  EXPECT_GT(chart.ByteSizeLong(), kMostChartBytes / 4);
  EXPECT_GT(chart.tolerance_m(), 0.0);
  EXPECT_GT(chart.marks_size(), 1000);
  EXPECT_EQ(chart.marks_size() + static_cast<int>(chart.marks_left_out()), 9000);
  EXPECT_EQ(chart.marks(0).latitude(), 0) << "the nearest is kept";

  echo::CoastChart islands;  // many and small
  for (int i = 0; i < 20'000; ++i) {
    const double lat = 59.9 + 0.2 * (i % 141) / 141.0, lon = 4.8 + 0.4 * (i / 141) / 141.0;
    const double size = 1e-4 * (1 + i % 7);
    islands.rings.push_back(shore_ring({{lat, lon}, {lat, lon + size}, {lat + size, lon}}));
  }
  const wire::ChartObjects many = chart_objects_of(islands, {}, asked_about(60.0, 5.0, 12.0));
  EXPECT_LE(many.ByteSizeLong(), kMostChartBytes);
  EXPECT_EQ(many.lines_size(), kMostChartLines) << "islands do not all go";
  EXPECT_EQ(many.lines_left_out(), 20'000u - kMostChartLines);
}

TEST(ChartObjects, OpenLinesThatAreTooManyAreLeftOutTheShortestFirst) {
  echo::CoastChart coast;
  coast.rings = {shore_ring({{60.0, 5.0}, {60.0, 5.001}, {60.001, 5.0}}),
                 shore_ring({{60.0, 5.1}, {60.0, 5.2}, {60.05, 5.15}})};
  echo::ChartDetail detail;
  for (int i = 0; i < 20'000; ++i) {
    const double lat = 59.9 + 0.2 * (i % 141) / 141.0, lon = 4.8 + 0.4 * (i / 141) / 142.0;
    detail.contours.push_back({5.0f, {{lat, lon}, {lat, lon + 1e-4 * (i < 100 ? 5 : 1)}}});
  }
  const wire::ChartObjects chart = chart_objects_of(coast, detail, asked_about(60.0, 5.0, 12.0));
  EXPECT_LE(chart.ByteSizeLong(), kMostChartBytes);
  EXPECT_EQ(chart.tolerance_m(), 0.0) << "the lines that are told are as they were asked for";
  EXPECT_EQ(chart.lines_size(), kMostChartLines);
  EXPECT_EQ(chart.lines(0).kind(), wire::ChartLine::COAST);
  EXPECT_NEAR(places_of(chart, 0)[0].longitude_deg, 5.15, 0.06) << "the larger island";
  EXPECT_EQ(chart.lines(1).kind(), wire::ChartLine::COAST);
  EXPECT_EQ(chart.lines(2).kind(), wire::ChartLine::DEPTH_CONTOUR);
  EXPECT_EQ(chart.lines_size() + static_cast<int>(chart.lines_left_out()), 2 + 20'000);
  for (int line = 2; line < 102; ++line) {
    const std::vector<GeoPoint> ends = places_of(chart, line);
    EXPECT_GT(ends[1].longitude_deg - ends[0].longitude_deg, 4e-4) << "the longest are kept";
  }
  // Where the bytes are the limit.
  for (const std::size_t most : {1000u, 5000u, 50'000u}) {
    const wire::ChartObjects less =
        chart_objects_of(coast, detail, asked_about(60.0, 5.0, 12.0), most);
    EXPECT_LE(less.ByteSizeLong(), most);
    EXPECT_GT(less.ByteSizeLong(), most - 60) << "it is used";
    EXPECT_EQ(less.tolerance_m(), kMostTolerance * 12.0 * 1852.0);
    ASSERT_GT(less.lines_size(), 0);
    EXPECT_EQ(less.lines(0).kind(), wire::ChartLine::COAST) << "the island that is large enough";
    EXPECT_EQ(less.lines_size() + static_cast<int>(less.lines_left_out()), 1 + 20'000);
  }
}

TEST(ChartObjects, HaveAtMostSoManyMarksAndANameThatCanBeSent) {
  echo::CoastChart coast;
  coast.source = "caf\xe9 ";
  while (coast.source.size() < 300) coast.source += "\xc3\xa5";
  echo::ChartDetail detail;
  for (int i = 0; i < 9000; ++i) {
    echo::ChartMark mark;
    mark.place = {60.0 + 1e-5 * i, 5.0};
    detail.marks.push_back(mark);
  }
  const wire::ChartObjects chart = chart_objects_of(coast, detail, asked_about(60.0, 5.0, 10.0));
  EXPECT_EQ(chart.marks_size(), kMostChartMarks);
  EXPECT_EQ(chart.marks_left_out(), 9000u - kMostChartMarks);
  EXPECT_EQ(chart.chart().substr(0, 7), "caf? \xc3\xa5");
  EXPECT_EQ(chart.chart().size(), 199u) << "whole characters, at most 200 bytes";
}

class CountedChart final : public echo::ChartSource {
 public:
  echo::CoastChart load(GeoPoint, Length) const override {
    ++loads;
    return {};
  }
  std::string describe() const override { return "counted"; }
  mutable int loads = 0;
};

TEST(ChartObjects, AnAnswerIsKeptForTheNextWhoAsksForTheSame) {
  const CountedChart chart;
  ChartObjectsMaker maker;
  for (int i = 0; i < 3; ++i) maker.about(chart, asked_about(60.0, 5.0, 10.0));
  EXPECT_EQ(chart.loads, 1);
  maker.about(chart, asked_about(60.0, 5.0, 10.0, 5.0));
  EXPECT_EQ(chart.loads, 2);
  for (int i = 0; i < static_cast<int>(ChartObjectsMaker::kKept); ++i)
    maker.about(chart, asked_about(61.0 + i, 5.0, 10.0));
  maker.about(chart, asked_about(60.0, 5.0, 10.0));
  EXPECT_EQ(chart.loads, 3 + static_cast<int>(ChartObjectsMaker::kKept)) << "the oldest went";
}

}  // namespace
}  // namespace skerry::server
