// Land cover and marinas out of ENC cells, GeoJSON, and charts over each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "echo/chart/cover_grid.hpp"
#include "echo/chart/gdal/layered_chart.hpp"
#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "echo/chart/gdal/vector_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/made_cell.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::size_t craft_in(const CoastChart& chart) {
  return static_cast<std::size_t>(
      std::count_if(chart.objects.begin(), chart.objects.end(),
                    [](const ChartObject& o) { return o.kind == ObjectClass::craft; }));
}
std::map<LandCover, int> covers_in(const CoastChart& chart) {
  std::map<LandCover, int> found;
  for (const CoverArea& area : chart.covers) ++found[area.cover];
  return found;
}

class CoverCharts : public testing::Test {
 protected:
  CoastChart load(const MadeCell& cell) {
    cell.write(folder_ / "TEST0001.000");
    return S57Chart::open(folder_ / "TEST0001.000", warnings_).load({50.05, -0.95}, metres(20000));
  }
  std::unique_ptr<VectorChart> vector(const std::string& features,
                                      const std::string& name = "town.geojson") {
    write_text(folder_ / name,
               "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}");
    return std::make_unique<VectorChart>(VectorChart::open(folder_ / name, warnings_));
  }
  CoastChart load(const std::string& features) {
    return vector(features)->load({50.05, -0.95}, metres(20000));
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

// The western third of the cell is land.
MadeCell covered_cell() {
  MadeCell cell;
  cell.area("M_COVR", {box(50.0, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
  cell.area("LNDARE", {{{50.0, -1.0}, {50.0, -0.97}, {50.1, -0.97}, {50.1, -1.0}}});
  return cell;
}

TEST_F(CoverCharts, AreasOfACellAreCoversByClassAndCategory) {
  MadeCell cell = covered_cell();
  cell.area("LNDRGN", {box(50.0, -1.0, 50.09, -0.975)}, {{"CATLND", "2"}});
  cell.area("BUAARE", {box(50.01, -0.995, 50.02, -0.985)}, {{"CATBUA", "1"}});
  cell.area("VEGATN", {box(50.03, -0.995, 50.04, -0.985)}, {{"CATVEG", "6"}});
  cell.area("VEGATN", {box(50.05, -0.995, 50.06, -0.985)}, {{"CATVEG", "1"}});
  cell.area("VEGATN", {box(50.07, -0.995, 50.08, -0.985)});
  cell.area("RUNWAY", {box(50.055, -0.994, 50.056, -0.986)});
  cell.point("BUAARE", {50.09, -0.99});
  const CoastChart chart = load(cell);
  EXPECT_THAT(warnings_, IsEmpty());
  const auto grid = CoverGrid::of(chart);
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->at({50.005, -0.98}), LandCover::marsh);
  EXPECT_EQ(grid->at({50.015, -0.99}), LandCover::built_up) << "the smaller area lies above";
  EXPECT_EQ(grid->at({50.035, -0.99}), LandCover::forest);
  EXPECT_EQ(grid->at({50.058, -0.99}), LandCover::grass);
  EXPECT_EQ(grid->at({50.0555, -0.99}), LandCover::paved);
  EXPECT_EQ(grid->at({50.075, -0.99}), LandCover::marsh)
      << "vegetation of no category says nothing";
  EXPECT_EQ(grid->at({50.095, -0.99}), LandCover::none);
  EXPECT_EQ(CoverGrid::of(load(covered_cell())), nullptr);
}

TEST_F(CoverCharts, MarinasOfACellHoldCraftOffTheLand) {
  MadeCell cell = covered_cell();
  cell.area("HRBFAC", {box(50.02, -0.972, 50.022, -0.966)}, {{"CATHAF", "5"}});
  const CoastChart marina = load(cell);
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_GT(craft_in(marina), 50u);
  for (const ChartObject& o : marina.objects) {
    if (o.kind != ObjectClass::craft) continue;
    EXPECT_FALSE(is_land(marina, o.outline[0]));
    EXPECT_GT(o.outline[0].longitude_deg, -0.97);
  }
  MadeCell other = covered_cell();
  other.area("HRBFAC", {box(50.02, -0.972, 50.022, -0.966)}, {{"CATHAF", "3"}});
  EXPECT_EQ(craft_in(load(other)), 0u) << "a ferry terminal";
  other.line("BERTHS", {{50.04, -0.96}, {50.042, -0.96}});
  EXPECT_EQ(craft_in(load(other)), 0u) << "ships lie there";
  other.point("SMCFAC", {50.041, -0.9605}, {{"CATSCF", "1"}});
  EXPECT_GT(craft_in(load(other)), 20u);
}

std::string tagged(const std::string& properties, double south, double west, double size = 0.01) {
  const auto at = [](double lon, double lat) {
    return "[" + std::to_string(lon) + "," + std::to_string(lat) + "]";
  };
  return "{\"type\": \"Feature\", \"properties\": {" + properties +
         "}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [[" + at(west, south) + "," +
         at(west + size, south) + "," + at(west + size, south + size) + "," +
         at(west, south + size) + "," + at(west, south) + "]]}}";
}

TEST_F(CoverCharts, PropertiesOfGeoJsonNameCovers) {
  const std::map<std::string, LandCover> named = {
      {"\"landuse\": \"residential\"", LandCover::built_up},
      {"\"landuse\": \"Industrial\"", LandCover::industrial},
      {"\"landuse\": \"forest\"", LandCover::forest},
      {"\"landuse\": \"meadow\"", LandCover::grass},
      {"\"landuse\": \"farmland\"", LandCover::farmland},
      {"\"natural\": \"wood\"", LandCover::forest},
      {"\"natural\": \"scrub\"", LandCover::scrub},
      {"\"natural\": \"wetland\"", LandCover::marsh},
      {"\"natural\": \"wetland\", \"wetland\": \"mangrove\"", LandCover::mangrove},
      {"\"natural\": \"bare_rock\"", LandCover::rock},
      {"\"natural\": \"beach\", \"landuse\": \"forest\"", LandCover::sand},
      {"\"building\": \"yes\"", LandCover::built_up},
      {"\"building\": \"no\", \"landuse\": \"grass\"", LandCover::grass},
      {"\"aeroway\": \"runway\"", LandCover::paved},
      {"\"kind\": \"cover\", \"cover\": \"ice\"", LandCover::ice},
  };
  for (const auto& [properties, cover] : named) {
    const CoastChart chart = load(tagged(properties, 50.0, -1.0));
    ASSERT_EQ(chart.covers.size(), 1u) << properties;
    EXPECT_EQ(chart.covers[0].cover, cover) << properties;
    EXPECT_THAT(chart.rings, IsEmpty()) << properties << " is no land of its own";
  }
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(load(tagged("\"natural\": \"coastline\"", 50.0, -1.0)).rings.size(), 1u);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(CoverCharts, WhatCannotBeUsedIsReportedByFileAndFeature) {
  const std::string land = tagged("\"type\": \"rocky\"", 50.0, -1.0);
  load(land + "," + tagged("\"landuse\": \"moonscape\"", 50.0, -1.0) + "," +
       tagged("\"kind\": \"cover\", \"cover\": \"lava\"", 50.0, -1.0) + "," +
       "{\"type\": \"Feature\", \"properties\": {\"natural\": \"wood\"}, \"geometry\": "
       "{\"type\": \"Point\", \"coordinates\": [-1.0, 50.0]}}" +
       ",{\"type\": \"Feature\", \"properties\": {\"natural\": \"wood\"}, \"geometry\": "
       "{\"type\": \"Polygon\", \"coordinates\": [[[-1.0, 50.0], [-1.0, 50.0]]]}}");
  EXPECT_THAT(warnings_,
              ElementsAre(AllOf(HasSubstr("town.geojson"), HasSubstr("feature 1"),
                                HasSubstr("landuse=moonscape")),
                          AllOf(HasSubstr("feature 2"), HasSubstr("unknown cover \"lava\"")),
                          AllOf(HasSubstr("feature 3"), HasSubstr("no area to cover")),
                          AllOf(HasSubstr("feature 4"), HasSubstr("left out"))));
  EXPECT_THAT(complaint_of([&] {
                load(
                    "{\"type\": \"Feature\", \"properties\": {\"landuse\": \"x\"}, \"geometry\": "
                    "null}");
              }),
              HasSubstr("no land and no objects or land cover"));
}

TEST_F(CoverCharts, AMarinaOfGeoJsonHoldsCraft) {
  const CoastChart chart = load(tagged("\"leisure\": \"marina\"", 50.0, -1.0, 0.002));
  EXPECT_GT(craft_in(chart), 100u);
  EXPECT_EQ(craft_in(chart), chart.objects.size());
  EXPECT_THAT(warnings_, IsEmpty());
  load(tagged("\"leisure\": \"marina\"", 50.0, -1.0, 0.05));
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("town.geojson: "), HasSubstr("feature 0"),
                                           HasSubstr("moored craft"))));
}

TEST_F(CoverCharts, HigherChartsCoverLowerOnes) {
  // Below: forest on its island, and a marina that the upper chart's land lies in.
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(vector(
      tagged("", 50.0, -1.0) + "," + tagged("\"landuse\": \"residential\"", 50.0, -1.0, 0.005),
      "upper.geojson"));
  charts.push_back(
      vector(tagged("", 50.0, -1.0, 0.05) + "," + tagged("\"natural\": \"wood\"", 50.0, -1.0, 0.05),
             "lower.geojson"));
  const LayeredChart layered(std::move(charts));
  const auto grid = CoverGrid::of(layered.load({50.02, -0.98}, metres(10000)));
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->at({50.002, -0.998}), LandCover::built_up);
  EXPECT_EQ(grid->at({50.007, -0.993}), LandCover::none) << "the upper chart answers for this";
  EXPECT_EQ(grid->at({50.03, -0.97}), LandCover::forest);

  // Covers alone answer for no place, and lie over any land.
  charts.clear();
  charts.push_back(vector(tagged("\"landuse\": \"residential\"", 50.0, -1.0, 0.005) + "," +
                              tagged("\"leisure\": \"marina\"", 50.048, -0.952, 0.004),
                          "alone.geojson"));
  charts.push_back(
      vector(tagged("", 50.0, -1.0, 0.05) + "," + tagged("\"natural\": \"wood\"", 50.0, -1.0, 0.05),
             "lower.geojson"));
  const CoastChart chart = LayeredChart(std::move(charts)).load({50.02, -0.98}, metres(10000));
  const auto both = CoverGrid::of(chart);
  ASSERT_NE(both, nullptr);
  EXPECT_EQ(both->at({50.002, -0.998}), LandCover::built_up);
  EXPECT_EQ(both->at({50.007, -0.993}), LandCover::forest);
  EXPECT_GT(craft_in(chart), 20u);
  for (const ChartObject& o : chart.objects) EXPECT_FALSE(is_land(chart, o.outline[0]));
}

// What the layers of the cells hold (as ogrinfo lists them): US5WA22M 4 BUAARE polygons, 10 LNDRGN
// polygons of CATLND 2, 561 PONTON lines and 21 polygons; US5OH10M 3 BUAARE, 40 LNDRGN of CATLND 2,
// 2 AIRARE, 4 HRBFAC points of CATHAF 5, one PONTON; US5MA1BO none.
TEST_F(CoverCharts, RealCells) {
  const auto open = [&](const char* name, GeoPoint centre) {
    return S57Chart::open(enc_cell(name), warnings_).load(centre, metres(100000));
  };
  for (const char* name : {"US5WA22M", "US5OH10M", "US5MA1BO"}) {
    if (!std::filesystem::exists(enc_cell(name))) GTEST_SKIP() << "no chart " << enc_cell(name);
  }
  const CoastChart tacoma = open("US5WA22M", {47.278, -122.453});
  EXPECT_EQ(covers_in(tacoma)[LandCover::built_up], 4);
  EXPECT_EQ(covers_in(tacoma)[LandCover::marsh], 10);
  EXPECT_EQ(tacoma.covers.size(), 14u);
  std::printf("US5WA22M: %zu moored craft\n", craft_in(tacoma));
  EXPECT_GT(craft_in(tacoma), 1000u);
  for (const ChartObject& o : tacoma.objects)
    EXPECT_FALSE(o.kind == ObjectClass::craft && is_land(tacoma, o.outline[0]));
  const auto grid = CoverGrid::of(tacoma);
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->at({47.25, -122.45}), LandCover::built_up) << "downtown Tacoma";

  const CoastChart sandusky = open("US5OH10M", {41.62, -82.79});
  EXPECT_EQ(covers_in(sandusky)[LandCover::built_up], 3);
  EXPECT_EQ(covers_in(sandusky)[LandCover::marsh], 40);
  EXPECT_EQ(covers_in(sandusky)[LandCover::grass], 2);
  std::printf("US5OH10M: %zu moored craft\n", craft_in(sandusky));
  EXPECT_GT(craft_in(sandusky), 0u);

  const CoastChart nantucket = open("US5MA1BO", {41.2875, -70.3125});
  EXPECT_THAT(nantucket.covers, IsEmpty());
  EXPECT_EQ(craft_in(nantucket), 0u);
  EXPECT_THAT(warnings_, IsEmpty());
}

}  // namespace
}  // namespace skerry::echo
