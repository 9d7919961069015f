// Charts that would take without end, or that mean the whole Earth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/layered_chart.hpp"
#include "echo/chart/gdal/polygons/box_tree.hpp"
#include "echo/chart/gdal/polygons/clip_area.hpp"
#include "echo/chart/gdal/polygons/cut_lines.hpp"
#include "echo/chart/gdal/vector_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kEarth = 2.1e7;

std::string json_of(const Line& line, bool closed) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < line.size() + (closed ? 1 : 0); ++i) {
    const GeoPoint p = line[i % line.size()];
    places.push_back(fmt::format("[{},{}]", p.longitude_deg, p.latitude_deg));
  }
  return fmt::format("[{}]", fmt::join(places, ","));
}
std::string feature_of(const std::string& type, const std::string& coordinates,
                       const std::string& kind) {
  return fmt::format(
      R"({{"type": "Feature", "properties": {{"kind": "{}"}},
          "geometry": {{"type": "{}", "coordinates": {}}}}})",
      kind, type, coordinates);
}
std::string polygon_of(const std::vector<Line>& rings, const std::string& kind = "") {
  std::vector<std::string> texts;
  for (const Line& ring : rings) texts.push_back(json_of(ring, true));
  return feature_of("Polygon", fmt::format("[{}]", fmt::join(texts, ",")), kind);
}
std::string buoy(double latitude, double longitude) {
  return feature_of("Point", fmt::format("[{},{}]", longitude, latitude), "buoy");
}
const Line kIslandBox = box(50.0, -1.0, 50.1, -0.9);
const Line kWorld = box(-90.0, -180.0, 90.0, 180.0);

class ChartBounds : public testing::Test {
 protected:
  std::unique_ptr<VectorChart> open(const std::vector<std::string>& features,
                                    const std::string& name = "harbour.geojson") {
    write_text(folder_ / name, fmt::format(R"({{"type": "FeatureCollection", "features": [{}]}})",
                                           fmt::join(features, ",")));
    return std::make_unique<VectorChart>(VectorChart::open(folder_ / name, warnings_));
  }
  CoastChart earth_of(const std::vector<std::string>& features) {
    return open(features)->load({0.0, 0.0}, metres(kEarth));
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

// Independent of the reader: the box as written, x from -180 to 180.
bool inside(const Line& corners, GeoPoint p) {
  return p.latitude_deg > corners[0].latitude_deg && p.latitude_deg < corners[2].latitude_deg &&
         p.longitude_deg > corners[0].longitude_deg && p.longitude_deg < corners[2].longitude_deg;
}
GeoPoint somewhere(std::uint64_t i) {
  return {178.0 * as_unit(mixed(i, 1)) - 89.0, 359.98 * as_unit(mixed(i, 2)) - 179.99};
}

TEST_F(ChartBounds, WorldWidePolygonsAreLandWithHoles) {
  const Line belt = box(-60.0, -180.0, 40.0, 180.0);
  const Line cap = box(-90.0, -180.0, -60.0, 180.0);
  const Line lake = box(-10.0, 20.0, 20.0, 50.0), pond = box(-70.0, -130.0, -65.0, -20.0);
  const std::vector<std::vector<Line>> cases = {
      {kWorld}, {kWorld, lake}, {kWorld, lake, pond}, {belt}, {belt, lake}, {cap}, {cap, pond}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const CoastChart chart = earth_of({polygon_of(cases[k])});
    EXPECT_THAT(warnings_, IsEmpty()) << "case " << k;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const GeoPoint place = somewhere(i);
      bool expected = inside(cases[k][0], place);
      for (std::size_t h = 1; h < cases[k].size(); ++h)
        expected = expected && !inside(cases[k][h], place);
      ASSERT_EQ(winding_number(chart, place), expected ? 1 : 0)
          << "case " << k << ", " << place.latitude_deg << " " << place.longitude_deg;
    }
  }
}

TEST_F(ChartBounds, AHoleAcrossTheAntimeridianIsTakenOutOfTheWorld) {
  const CoastChart chart = earth_of({polygon_of({kWorld, box(-10.0, 170.0, 10.0, -170.0)})});
  for (const double longitude : {171.0, 179.9, -180.0, -179.9, -171.0})
    EXPECT_EQ(winding_number(chart, {1.0, longitude}), 0) << longitude;
  for (const double longitude : {169.0, 0.0, -169.0}) {
    EXPECT_EQ(winding_number(chart, {1.0, longitude}), 1) << longitude;
    EXPECT_EQ(winding_number(chart, {11.0, longitude}), 1) << longitude;
  }
}

TEST_F(ChartBounds, AWorldWideCoverageWithAHoleLeavesItToTheLowerChart) {
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(open(
      {polygon_of({kIslandBox}), polygon_of({kWorld, box(0.0, 10.0, 10.0, 20.0)}, "coverage")}));
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_FALSE(dynamic_cast<VectorChart&>(*charts[0]).coverage().contains({5.0, 15.0}));
  for (const double longitude : {-179.9, -90.0, 0.0, 179.9})
    EXPECT_TRUE(dynamic_cast<VectorChart&>(*charts[0]).coverage().contains({-5.0, longitude}));
  charts.push_back(open({polygon_of({box(-5.0, 5.0, 5.0, 15.0)})}, "lower.geojson"));
  const LayeredChart layered(std::move(charts));
  for (const double centre : {15.0, 100.0, -100.0}) {
    const CoastChart window = layered.load({0.0, centre}, metres(1.5e7));
    EXPECT_EQ(winding_number(window, {4.0, 12.0}), 1) << centre;
    EXPECT_EQ(winding_number(window, {4.0, 8.0}), 0) << centre;
    EXPECT_EQ(winding_number(window, {-4.0, 12.0}), 0) << centre;
  }
}

TEST_F(ChartBounds, AWorldOfLandIsCutByAHigherChart) {
  for (const double west : {-179.0, -100.0, 0.0, 85.0, 177.0}) {
    std::vector<std::unique_ptr<ChartSource>> charts;
    const double east = wrapped_longitude(west + 10.0);
    charts.push_back(open(
        {polygon_of({box(1.0, wrapped_longitude(west + 1.0), 2.0, wrapped_longitude(west + 2.0))}),
         polygon_of({box(0.0, west, 10.0, east)}, "coverage")}));
    charts.push_back(open({polygon_of({kWorld})}, "lower.geojson"));
    EXPECT_THAT(warnings_, IsEmpty());
    const GeoPoint centre{5.0, wrapped_longitude(west + 5.0)};
    const CoastChart window = LayeredChart(std::move(charts)).load(centre, metres(1e6));
    EXPECT_EQ(winding_number(window, {1.5, wrapped_longitude(west + 1.5)}), 1) << west;
    for (const double in : {0.5, 3.5, 9.5})
      EXPECT_EQ(winding_number(window, {5.0, wrapped_longitude(west + in)}), 0) << west;
    for (const double out : {-0.5, 10.5})
      EXPECT_EQ(winding_number(window, {5.0, wrapped_longitude(west + out)}), 1) << west;
  }
}

TEST_F(ChartBounds, AnUncutPolygonAcrossTheAntimeridianIsLandWithin) {
  for (const bool reversed : {false, true}) {
    Line outer = {{-17.0, 179.0},  {-17.0, 180.0},  {-17.0, -180.0},
                  {-17.0, -179.0}, {-16.0, -179.0}, {-16.0, 179.0}};
    const Line lake = box(-16.7, 179.8, -16.3, -179.8);
    if (reversed) std::reverse(outer.begin(), outer.end());
    const CoastChart chart = earth_of({polygon_of({outer, lake})});
    EXPECT_THAT(warnings_, IsEmpty());
    for (const double longitude : {179.5, -179.5}) {
      EXPECT_EQ(winding_number(chart, {-16.5, longitude}), 1) << longitude;
    }
    for (const double longitude : {178.5, 179.9, -180.0, -179.9, -178.5, 0.0, 90.0})
      EXPECT_EQ(winding_number(chart, {-16.5, longitude}), 0) << longitude;
  }
}

TEST_F(ChartBounds, ARingAroundAPoleHoldsThePoleOfItsHemisphere) {
  Line ice;
  for (int longitude = -175; longitude < 180; longitude += 10)
    ice.push_back({-70.0 + longitude % 20 / 5, 1.0 * longitude});
  for (const bool reversed : {false, true}) {
    if (reversed) std::reverse(ice.begin(), ice.end());
    const CoastChart chart = earth_of({polygon_of({ice})});
    EXPECT_THAT(warnings_, IsEmpty());
    for (double longitude = -179.5; longitude < 180.0; longitude += 1.0) {
      EXPECT_EQ(winding_number(chart, {-80.0, longitude}), 1) << longitude;
      EXPECT_EQ(winding_number(chart, {-60.0, longitude}), 0) << longitude;
      EXPECT_EQ(winding_number(chart, {80.0, longitude}), 0) << longitude;
    }
  }
  for (std::size_t i = 0; i < ice.size(); i += 2) ice[i].latitude_deg = 1.0;
  earth_of({polygon_of({kIslandBox}), polygon_of({ice})});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("which pole")));
}

TEST_F(ChartBounds, AnOuterRingOfNothingTakesItsHolesAlong) {
  const Line flat = {{50.0, 1.0}, {50.0, 2.0}, {50.0, 3.0}};
  for (const char* kind : {"", "coverage"}) {
    warnings_.clear();
    const CoastChart chart =
        earth_of({polygon_of({kIslandBox}), polygon_of({flat, box(49.5, 1.0, 49.6, 1.1)}, kind)});
    EXPECT_THAT(warnings_, Contains(HasSubstr("harbour feature 1")));
    EXPECT_EQ(winding_number(chart, {50.05, -0.95}), 1);
  }
}

TEST_F(ChartBounds, ATangledRingIsLeftOutAndNamed) {
  Line tangle;
  for (std::uint64_t i = 0; i < 3000; ++i)
    tangle.push_back({50.0 + as_unit(mixed(i, 1)), as_unit(mixed(i, 2))});
  const CoastChart chart = earth_of({polygon_of({kIslandBox}), polygon_of({tangle})});
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("harbour.geojson: harbour feature 1"),
                                           HasSubstr("cross more than 1000 times"))));
  EXPECT_EQ(chart.rings.size(), 1u);
}

// Two combs, each sound by itself, are a polygon whose teeth cross.
TEST_F(ChartBounds, AHoleThatCrossesItsRingEverywhereIsLeftOut) {
  Line comb{{52.0, -0.1}, {49.9, -0.1}}, across{{51.0, 1.2}, {51.0, 1.3}, {49.5, 1.3}};
  for (int i = 0; i < 100; ++i) {
    const double x = 0.01 * i;
    comb.insert(comb.end(), {{49.9, x}, {51.5, x}, {51.5, x + 0.005}, {49.9, x + 0.005}});
    const double y = 50.0 + 0.01 * i;
    across.insert(across.end(), {{y, 1.2}, {y, -0.05}, {y + 0.005, -0.05}, {y + 0.005, 1.2}});
  }
  comb.insert(comb.end(), {{49.9, 1.5}, {52.0, 1.5}});
  earth_of({polygon_of({kIslandBox}), polygon_of({comb, across})});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("cross more than 1000 times")));
}

TEST_F(ChartBounds, ManyTangledPolygonsAreMendedUpToABound) {
  std::vector<std::string> features = {polygon_of({kIslandBox})};
  for (unsigned k = 0; k < 40; ++k) {
    Line tangle;
    for (std::uint64_t i = 0; i < 45; ++i)
      tangle.push_back({10.0 + as_unit(mixed(k, i, 1)), 1.0 * k + 0.9 * as_unit(mixed(k, i, 2))});
    features.push_back(polygon_of({tangle}));
  }
  earth_of(features);
  EXPECT_THAT(warnings_, Contains(HasSubstr("mended")));
  EXPECT_THAT(warnings_, Contains(HasSubstr("as too many of this chart's do already")));
}

TEST_F(ChartBounds, ASlantingCombIsLeftOutBeforeItsEdgesAreComparedWithOneAnother) {
  Line comb;
  for (int i = 0; i < 12'000; ++i) {
    const double x = 1e-4 * i;
    comb.insert(comb.end(), {{20.0 - x, x}, {40.0 - x, 20.0 + x}});
  }
  comb.push_back({45.0, 0.0});
  earth_of({polygon_of({kIslandBox}), polygon_of({comb})});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("left out")));
}

TEST_F(ChartBounds, ObjectsAloneCoverNothing) {
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(open({buoy(40.0, -20.0), buoy(60.0, 20.0), buoy(50.05, -0.95)}));
  EXPECT_FALSE(dynamic_cast<VectorChart&>(*charts[0]).coverage().everywhere());
  EXPECT_FALSE(dynamic_cast<VectorChart&>(*charts[0]).coverage().contains({50.05, -0.95}));
  charts.push_back(open({polygon_of({kIslandBox}), buoy(50.2, -0.95)}, "lower.geojson"));
  const CoastChart window = LayeredChart(std::move(charts)).load({50.0, -1.0}, metres(50000));
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(winding_number(window, {50.05, -0.95}), 1);
  ASSERT_EQ(window.rings.size(), 1u);
  EXPECT_EQ(
      std::count(window.rings[0].edges.begin(), window.rings[0].edges.end(), EdgeKind::shoreline),
      4);
  ASSERT_EQ(window.objects.size(), 2u);
  EXPECT_DOUBLE_EQ(window.objects[0].outline[0].latitude_deg, 50.05);
  EXPECT_EQ(window.source, "chart harbour.geojson over chart lower.geojson");
}

TEST_F(ChartBounds, ObjectsDoNotWidenTheCoverageOfLand) {
  const auto chart = open({polygon_of({kIslandBox}), buoy(60.0, 20.0)});
  EXPECT_TRUE(chart->coverage().contains({50.05, -0.95}));
  EXPECT_FALSE(chart->coverage().contains({55.0, 10.0}));
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(open({polygon_of({kIslandBox}), buoy(60.0, 20.0)}));
  charts.push_back(open({polygon_of({box(59.0, 19.0, 61.0, 19.5)})}, "lower.geojson"));
  const CoastChart window = LayeredChart(std::move(charts)).load({60.0, 20.0}, metres(100000));
  EXPECT_EQ(window.objects.size(), 1u) << "outside its chart's coverage";
  EXPECT_EQ(winding_number(window, {60.0, 19.2}), 1);
}

TEST_F(ChartBounds, WallsPastTheBoundAreLeftOut) {
  Line wall;
  for (int i = 0; i < 150'000; ++i) wall.push_back({50.0 + 1e-5 * i, 1.0});
  const CoastChart chart =
      open({polygon_of({kIslandBox}), feature_of("LineString", json_of(wall, false), "pier"),
            feature_of("LineString", json_of(wall, false), "breakwater"), buoy(50.2, -0.95)})
          ->load({50.5, 0.0}, metres(300000));
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("harbour feature 2"), HasSubstr("200000"))));
  EXPECT_EQ(chart.objects.size(), 2u);
}

TEST(ClipAreas, ATangledRingOfALowerChartIsRefusedAndNotCut) {
  CoastRing ring;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    ring.vertices.push_back({50.0 + as_unit(mixed(i, 1)), as_unit(mixed(i, 2))});
    ring.vertex_ids.push_back(i);
  }
  ring.edges.assign(ring.vertices.size(), EdgeKind::shoreline);
  Coverage half;
  half.polygons = {{box(49.0, 0.5, 52.0, 2.0)}};
  const std::vector<ClipArea> areas = ClipArea::of({&half}, 0.0);
  std::vector<CoastRing> out;
  EXPECT_THAT(complaint_of([&] { areas[0].clip(ring, out); }), HasSubstr("cross more than 1000"));
}

TEST(CutLines, FindEveryLineOfACombAndNoOther) {
  Line comb;
  constexpr int kTeeth = 20'000;
  for (int i = 0; i < kTeeth; ++i) {
    const double x = wrapped_longitude(170.0 + 1e-3 * i);
    comb.insert(comb.end(), {{-40.0, x}, {40.0, x}});
  }
  const std::size_t lines_in_comb = comb.size();
  Coverage coverage;
  coverage.polygons = {{comb}};
  const auto before = mallinfo2();  // zeros where another allocator is in its place
  const CutLines lines(coverage);
  const auto after = mallinfo2();
  EXPECT_LT((after.uordblks + after.hblkhd) - (before.uordblks + before.hblkhd),
            lines_in_comb * 400)
      << "bytes";
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const int tooth = static_cast<int>(as_unit(mixed(i, 1)) * kTeeth);
    const double x = wrapped_longitude(170.0 + 1e-3 * tooth),
                 y = 70.0 * as_unit(mixed(i, 2)) - 35.0;
    EXPECT_TRUE(lines.carries({y, x}, {y + 1.0, x})) << tooth;
    EXPECT_TRUE(lines.carries({y, wrapped_longitude(x + 1e-7)}, {y + 1.0, x})) << tooth;
    EXPECT_FALSE(lines.carries({y, wrapped_longitude(x + 4e-7)}, {y + 1.0, x})) << tooth;
    EXPECT_FALSE(lines.carries({y, x}, {y + 1.0, wrapped_longitude(x + 1e-3)})) << tooth;
  }
}

TEST(BoxTree, FindsAndJoinsWhatTouches) {
  std::vector<PlaneBox> boxes;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const double x = as_unit(mixed(i, 1)), y = as_unit(mixed(i, 2));
    boxes.push_back({x, y, x + 0.1 * as_unit(mixed(i, 3)), y + 0.1 * as_unit(mixed(i, 4))});
  }
  const BoxTree tree(boxes);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    std::vector<std::uint32_t> near, told;
    for (std::uint32_t j = 0; j < boxes.size(); ++j) {
      if (!boxes[i].touches(boxes[j])) continue;
      near.push_back(j);
      if (j > i) expected.emplace_back(i, j);
    }
    EXPECT_FALSE(tree.find(boxes[i], [&](std::uint32_t j) {
      told.push_back(j);
      return false;
    }));
    EXPECT_THAT(told, testing::UnorderedElementsAreArray(near));
  }
  tree.join(1'000'000, [&](std::uint32_t i, std::uint32_t j) {
    found.emplace_back(std::min(i, j), std::max(i, j));
    return false;
  });
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(tree.join(100, [](auto, auto) { return false; }), 101u) << "given up";
}

}  // namespace
}  // namespace skerry::echo
