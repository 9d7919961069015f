// Depths and marks of cells: those made for a test, and the NOAA cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "echo/chart/gdal/layered_chart.hpp"
#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/made_cell.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

MadeCell sea() {
  MadeCell cell;
  cell.area("M_COVR", {box(50.0, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
  cell.area("LNDARE", {box(50.0, -1.0, 50.1, -0.98)});
  return cell;
}

class S57Detail : public testing::Test {
 protected:
  std::unique_ptr<S57Chart> open(const MadeCell& cell, const char* name = "TEST0001.000") {
    cell.write(folder_ / name);
    return std::make_unique<S57Chart>(S57Chart::open(folder_ / name, warnings_));
  }
  ChartDetail detail(const MadeCell& cell) {
    return open(cell)->detail({50.05, -0.95}, metres(20000));
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

const ChartMark* at(const ChartDetail& detail, GeoPoint place) {
  const auto found = std::find_if(detail.marks.begin(), detail.marks.end(),
                                  [&](const ChartMark& mark) { return mark.place == place; });
  return found == detail.marks.end() ? nullptr : &*found;
}

TEST_F(S57Detail, ContoursKeepTheirDepths) {
  MadeCell cell = sea();
  cell.line("DEPCNT", {{50.02, -0.96}, {50.05, -0.95}, {50.08, -0.96}}, {{"VALDCO", "10"}});
  cell.line("DEPCNT", {{50.02, -0.97}, {50.08, -0.97}}, {{"VALDCO", "-1.5"}});
  cell.line("DEPCNT", {{50.02, -0.93}, {50.08, -0.93}});  // no depth
  const ChartDetail found = detail(cell);
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_TRUE(found.is_charted);
  ASSERT_EQ(found.contours.size(), 2u);
  EXPECT_FLOAT_EQ(found.contours[0].depth_m, 10.0f);
  EXPECT_THAT(found.contours[0].line,
              ElementsAre(GeoPoint{50.02, -0.96}, GeoPoint{50.05, -0.95}, GeoPoint{50.08, -0.96}));
  EXPECT_FLOAT_EQ(found.contours[1].depth_m, -1.5f);
}

TEST_F(S57Detail, MarksHaveKindColoursNameAndTheLightAtTheirPlace) {
  MadeCell cell = sea();
  cell.point("BOYLAT", {50.01, -0.95},
             {{"CATLAM", "1"}, {"BOYSHP", "4"}, {"COLOUR", "4"}, {"OBJNAM", "No. 1"}});
  cell.point("LIGHTS", {50.01, -0.95},
             {{"LITCHR", "2"}, {"SIGGRP", "(2)"}, {"COLOUR", "4"}, {"SIGPER", "5"}});
  cell.point("BCNCAR", {50.02, -0.95}, {{"CATCAM", "4"}, {"COLOUR", "6,2,6"}});
  cell.point("RTPBCN", {50.02, -0.95}, {{"CATRTB", "2"}, {"SIGGRP", "(Q)"}});
  cell.point("LIGHTS", {50.03, -0.95}, {{"LITCHR", "7"}, {"COLOUR", "1"}});
  cell.point("BOYSAW", {50.04, -0.95});
  cell.point("WRECKS", {50.05, -0.95}, {{"CATWRK", "2"}, {"VALSOU", "3.4"}});
  cell.point("UWTROC", {50.06, -0.95}, {{"WATLEV", "3"}, {"VALSOU", "-0.3"}});
  const ChartDetail found = detail(cell);
  EXPECT_EQ(found.marks.size(), 6u);

  const ChartMark* buoy = at(found, {50.01, -0.95});
  ASSERT_TRUE(buoy);
  EXPECT_EQ(buoy->kind, MarkKind::lateral_port);
  EXPECT_FALSE(buoy->fixed);
  EXPECT_EQ(buoy->shape, 4);
  EXPECT_THAT(buoy->colours, ElementsAre(4));
  EXPECT_EQ(buoy->name, "No. 1");
  EXPECT_EQ(buoy->light, "Fl(2) G 5s");
  EXPECT_FALSE(buoy->racon);

  const ChartMark* beacon = at(found, {50.02, -0.95});
  ASSERT_TRUE(beacon);
  EXPECT_EQ(beacon->kind, MarkKind::cardinal_west);
  EXPECT_TRUE(beacon->fixed);
  EXPECT_THAT(beacon->colours, ElementsAre(6, 2, 6));
  EXPECT_TRUE(beacon->racon);
  EXPECT_EQ(beacon->light, "");

  const ChartMark* light = at(found, {50.03, -0.95});
  ASSERT_TRUE(light);
  EXPECT_EQ(light->kind, MarkKind::light);
  EXPECT_EQ(light->light, "Iso W");
  EXPECT_EQ(at(found, {50.04, -0.95})->kind, MarkKind::safe_water);
  ASSERT_TRUE(at(found, {50.05, -0.95})->depth_m);
  EXPECT_FLOAT_EQ(*at(found, {50.05, -0.95})->depth_m, 3.4f);
  EXPECT_EQ(at(found, {50.06, -0.95})->kind, MarkKind::rock);
  EXPECT_FLOAT_EQ(*at(found, {50.06, -0.95})->depth_m, -0.3f);
  EXPECT_FALSE(at(found, {50.04, -0.95})->depth_m);
}

TEST_F(S57Detail, ARamarkIsNoRacon) {
  MadeCell cell = sea();
  cell.point("RTPBCN", {50.01, -0.95}, {{"CATRTB", "1"}});
  cell.point("BCNSPP", {50.02, -0.95});
  cell.point("RTPBCN", {50.02, -0.95}, {{"CATRTB", "1"}});
  cell.point("RTPBCN", {50.03, -0.95});  // of no category: a racon, as the echoes have it
  const ChartDetail found = detail(cell);
  ASSERT_EQ(found.marks.size(), 2u);
  EXPECT_FALSE(at(found, {50.02, -0.95})->racon);
  EXPECT_TRUE(at(found, {50.03, -0.95})->racon);
}

TEST_F(S57Detail, AnObstructionDrawnAsALineStandsAtItsMiddleVertex) {
  MadeCell cell = sea();
  cell.line("OBSTRN", {{50.02, -0.96}, {50.03, -0.95}, {50.05, -0.95}}, {{"VALSOU", "2.5"}});
  const ChartDetail found = detail(cell);
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_EQ(found.marks[0].kind, MarkKind::obstruction);
  EXPECT_EQ(found.marks[0].place, (GeoPoint{50.03, -0.95}));
  EXPECT_EQ(found.marks[0].depth_m, 2.5f);
}

TEST_F(S57Detail, DepthsThatAreNotInMetresAreLeftOut) {
  MadeCell cell = sea();
  cell.line("DEPCNT", {{50.02, -0.96}, {50.05, -0.95}}, {{"VALDCO", "10"}});
  cell.point("WRECKS", {50.05, -0.95}, {{"VALSOU", "3.4"}});
  const auto file = folder_ / "TEST0001.000";
  cell.write(file);  // GDAL's writer knows metres alone: DSPM is changed in the file
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  in.close();
  // CSCL 20000; DUNI, HUNI and PUNI 1.
  const std::size_t dspm = bytes.find(std::string("\x20\x4e\0\0\1\1\1", 7));
  ASSERT_NE(dspm, std::string::npos);
  bytes[dspm + 4] = '\2';  // fathoms and feet
  std::ofstream(file, std::ios::binary) << bytes;
  const ChartDetail found = S57Chart::open(file, warnings_).detail({50.05, -0.95}, metres(20000));
  EXPECT_THAT(warnings_, ElementsAre(testing::HasSubstr("depths are not in metres")));
  EXPECT_THAT(found.contours, IsEmpty());
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_FALSE(found.marks[0].depth_m);
}

TEST_F(S57Detail, OnlyWhatTheWindowTouchesIsHandedOut) {
  MadeCell cell = sea();
  cell.point("BOYSPP", {50.01, -0.95});
  cell.point("BOYSPP", {50.09, -0.95});
  cell.line("DEPCNT", {{50.085, -0.96}, {50.09, -0.94}}, {{"VALDCO", "5"}});
  const auto chart = open(cell);
  const ChartDetail near = chart->detail({50.01, -0.95}, metres(1000));
  EXPECT_EQ(near.marks.size(), 1u);
  EXPECT_THAT(near.contours, IsEmpty());
  EXPECT_TRUE(near.is_charted);
  EXPECT_FALSE(chart->detail({51.0, -0.95}, metres(1000)).is_charted);
  EXPECT_THROW(chart->detail({91.0, -0.95}, metres(1000)), std::invalid_argument);
}

TEST_F(S57Detail, AHigherChartHidesMarksAndContoursOfOneBelow) {
  MadeCell upper, lower;
  upper.area("M_COVR", {box(50.05, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
  upper.area("LNDARE", {box(50.05, -1.0, 50.1, -0.98)});
  upper.point("BOYSAW", {50.06, -0.95});
  lower = sea();
  lower.point("BOYSPP", {50.06, -0.95});
  lower.point("BOYSPP", {50.02, -0.95});
  lower.line("DEPCNT", {{50.01, -0.94}, {50.03, -0.94}, {50.07, -0.94}, {50.09, -0.94}},
             {{"VALDCO", "5"}});
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(open(upper, "UPPER001.000"));
  charts.push_back(open(lower, "LOWER001.000"));
  const ChartDetail found = LayeredChart(std::move(charts)).detail({50.05, -0.95}, metres(20000));
  ASSERT_EQ(found.marks.size(), 2u);
  EXPECT_EQ(at(found, {50.06, -0.95})->kind, MarkKind::safe_water);
  EXPECT_EQ(at(found, {50.02, -0.95})->kind, MarkKind::special);
  ASSERT_EQ(found.contours.size(), 1u);
  EXPECT_THAT(found.contours[0].line, ElementsAre(GeoPoint{50.01, -0.94}, GeoPoint{50.03, -0.94}));
  EXPECT_TRUE(found.is_charted);
}

// All that GDAL itself reads in the cell: 406 contours with 25 729 points; 3 BOYLAT, 10 BOYSPP, and
// their places.
TEST(S57DetailReal, TacomaHasItsContoursAndItsBuoysAtTheirPlaces) {
  if (!std::filesystem::exists(enc_cell("US5WA22M"))) GTEST_SKIP() << "no chart";
  TemporaryFolder folder;  // the cell without its updates
  std::filesystem::copy_file(enc_cell("US5WA22M"), folder / "US5WA22M.000");
  std::vector<std::string> warnings;
  const ChartDetail found =
      S57Chart::open(folder / "US5WA22M.000", warnings).detail({47.278, -122.453}, metres(100000));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(found.contours.size(), 406u);
  std::size_t points = 0;
  for (const DepthContour& contour : found.contours) points += contour.line.size();
  EXPECT_NEAR(static_cast<double>(points), 25729.0, 60.0) << "repeated places are dropped";

  GDALAllRegister();
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open((folder / "US5WA22M.000").c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  ASSERT_TRUE(dataset);
  int buoys = 0;
  for (const char* name : {"BOYLAT", "BOYSPP", "BCNLAT", "BCNSPP"}) {
    OGRLayer* layer = dataset->GetLayerByName(name);
    ASSERT_TRUE(layer) << name;
    for (const auto& feature : *layer) {
      const OGRPoint& point = *feature->GetGeometryRef()->toPoint();
      EXPECT_TRUE(at(found, {point.getY(), point.getX()})) << name << " " << buoys;
      ++buoys;
    }
  }
  EXPECT_EQ(buoys, 3 + 10 + 30);
}

}  // namespace
}  // namespace skerry::echo
