#include "echo/chart/gdal/vector_chart.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>

#include "echo/chart/land_mask.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class VectorCharts : public testing::Test {
 protected:
  // GeoJSON of these features, opened.
  VectorChart open(const std::string& features) {
    write_text(file_, "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}");
    return VectorChart::open(file_, warnings_);
  }
  CoastChart load(const std::string& features, GeoPoint centre = {50.0, -1.0}) {
    return open(features).load(centre, metres(200000));
  }
  std::string refusal(const std::string& text) {
    write_text(file_, text);
    return complaint_of([&] { VectorChart::open(file_, warnings_); });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "harbour.geojson";
  std::vector<std::string> warnings_;
};

std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties = "") {
  return "{\"type\": \"Feature\", \"properties\": {" + properties +
         "}, \"geometry\": {\"type\": \"" + type + "\", \"coordinates\": " + coordinates + "}}";
}
std::string polygon(const std::string& coordinates, const std::string& properties = "") {
  return feature("Polygon", coordinates, properties);
}
const std::string kIsland = "[[[-1.0,50.0],[-0.9,50.0],[-0.9,50.1],[-1.0,50.1],[-1.0,50.0]]]";

TEST_F(VectorCharts, PolygonsAreLandAndTheirHolesWater) {
  // The outer ring clockwise, its hole counter-clockwise: against the standard, and set right.
  const CoastChart chart =
      load(polygon("[[[-1.0,50.0],[-1.0,50.1],[-0.9,50.1],[-0.9,50.0],[-1.0,50.0]],"
                   "[[-0.97,50.03],[-0.93,50.03],[-0.93,50.07],[-0.97,50.07],[-0.97,50.03]]]",
                   "\"type\": \"Rocky\", \"height_m\": 12"));
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(winding_number(chart, {50.01, -0.95}), 1);
  EXPECT_EQ(winding_number(chart, {50.05, -0.95}), 0);
  EXPECT_EQ(winding_number(chart, {50.05, -0.85}), 0);
  ASSERT_EQ(chart.rings.size(), 2u);
  EXPECT_EQ(chart.rings[0].level, 1);
  EXPECT_EQ(chart.rings[1].level, 2);
  for (const CoastRing& ring : chart.rings) {
    for (std::size_t i = 0; i < ring.edges.size(); ++i) {
      EXPECT_EQ(ring.edges[i], EdgeKind::shoreline);
      EXPECT_EQ(shore_of(chart, ring, i), (Shore{CoastType::rocky, 12.0f}));
    }
  }
}

TEST_F(VectorCharts, OtherReferenceSystemsAreBroughtToWgs84) {
  // UTM zone 30 N: 3 W on the equator's northing is easting 500 000.
  const CoastChart chart = load(polygon(kIsland));
  GDALAllRegister();
  OGRSpatialReference utm, wgs84;
  ASSERT_EQ(utm.importFromEPSG(32630), OGRERR_NONE);
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::filesystem::path shape = folder_ / "harbour.shp";
  {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("ESRI Shapefile");
    GDALDatasetUniquePtr dataset(driver->Create(shape.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    ASSERT_TRUE(dataset);
    OGRLayer* layer = dataset->CreateLayer("harbour", &utm, wkbPolygon, nullptr);
    ASSERT_NE(layer, nullptr);
    OGRFieldDefn type("type", OFTString);
    ASSERT_EQ(layer->CreateField(&type), OGRERR_NONE);
    OGRPolygon land;
    OGRLinearRing ring;
    for (const GeoPoint p : chart.rings[0].vertices) ring.addPoint(p.longitude_deg, p.latitude_deg);
    ring.closeRings();
    land.addRing(&ring);
    std::unique_ptr<OGRCoordinateTransformation> to_utm(
        OGRCreateCoordinateTransformation(&wgs84, &utm));
    ASSERT_TRUE(to_utm);
    ASSERT_EQ(land.transform(to_utm.get()), OGRERR_NONE);
    OGRFeature one(layer->GetLayerDefn());
    one.SetField("type", "sandy");
    one.SetGeometry(&land);
    ASSERT_EQ(layer->CreateFeature(&one), OGRERR_NONE);
  }
  const CoastChart projected = VectorChart::open(shape, warnings_).load({50.0, -1.0}, metres(1e5));
  EXPECT_THAT(warnings_, IsEmpty());
  ASSERT_EQ(projected.rings.size(), 1u);
  ASSERT_EQ(projected.rings[0].vertices.size(), 4u);
  for (const GeoPoint p : chart.rings[0].vertices) {
    const bool found = std::any_of(
        projected.rings[0].vertices.begin(), projected.rings[0].vertices.end(), [&](GeoPoint q) {
          return std::hypot(p.latitude_deg - q.latitude_deg, p.longitude_deg - q.longitude_deg) <
                 2e-8;
        });
    EXPECT_TRUE(found) << p.latitude_deg << " " << p.longitude_deg;
  }
  EXPECT_EQ(shore_of(projected, projected.rings[0], 0).type, CoastType::sandy);
}

TEST_F(VectorCharts, ObjectsTakeWhatIsGivenAndDefaultsForTheRest) {
  const CoastChart chart = load(
      polygon(kIsland) + "," +
      feature("Point", "[-0.8,50.05]", "\"kind\": \"buoy\", \"name\": \"No 1\"") + "," +
      feature("Point", "[-0.79,50.05]",
              "\"kind\": \"Landmark\", \"height_m\": 44, \"cross_section_m2\": 7") +
      "," +
      feature("LineString", "[[-0.9,50.05],[-0.89,50.05],[-0.89,50.06]]",
              "\"kind\": \"pier\", \"height_m\": 3") +
      "," +
      polygon("[[[-0.7,50.0],[-0.69,50.0],[-0.69,50.01],[-0.7,50.0]]]", "\"kind\": \"building\"") +
      "," +
      feature("LineString", "[[-0.6,50.0],[-0.5,50.0]]",
              "\"kind\": \"bridge\", \"clearance_m\": 20") +
      "," + feature("Point", "[-0.4,50.05]", "\"kind\": \"racon\", \"racon\": \"N\""));
  EXPECT_THAT(warnings_, IsEmpty());
  ASSERT_EQ(chart.objects.size(), 6u);
  EXPECT_EQ(chart.objects[0].kind, ObjectClass::buoy);
  EXPECT_EQ(chart.objects[0].name, "No 1");
  EXPECT_FLOAT_EQ(chart.objects[0].height_m, 3.5f);
  EXPECT_FLOAT_EQ(chart.objects[0].cross_section_m2, 5.0f);
  EXPECT_FLOAT_EQ(chart.objects[1].height_m, 44.0f);
  EXPECT_FLOAT_EQ(chart.objects[1].cross_section_m2, 7.0f);
  EXPECT_EQ(chart.objects[2].outline.size(), 3u);
  EXPECT_FALSE(chart.objects[2].closed);
  EXPECT_TRUE(chart.objects[3].closed);
  EXPECT_EQ(chart.objects[3].outline.size(), 3u);
  EXPECT_FLOAT_EQ(chart.objects[4].clearance_m, 20.0f);
  EXPECT_FLOAT_EQ(chart.objects[4].height_m, 23.0f);
  EXPECT_EQ(chart.objects[5].racon_code, "N");
}

TEST_F(VectorCharts, WhatCannotBeUsedIsNamedAndTheRestUsed) {
  struct Case {
    std::string feature, complaint;
  };
  const std::vector<Case> cases = {
      {polygon("[[[-0.5,50.0],[-0.4,50.0],[-0.4,95.0],[-0.5,50.0]]]"), "latitude 95"},
      {polygon("[[[-0.5,50.0],[200.0,50.0],[-0.4,50.1],[-0.5,50.0]]]"), "longitude 200"},
      {polygon("[[[-0.5,50.0],[-0.4,50.0],[-0.5,50.0]]]"), "2 places bounds nothing"},
      {polygon("[[[-0.5,50.0],[-0.4,50.0],[-0.4,50.1],[-0.5,50.1]]]"), "not closed"},
      {polygon("[[[-0.5,50.0],[-0.4,50.1],[-0.4,50.0],[-0.5,50.1],[-0.5,50.0]]]"),
       "Self-intersection"},
      {polygon("[[[-0.5,50.0],[-0.4,50.0],[-0.4,50.1],[-0.5,50.0]]]", "\"type\": \"wooden\""),
       "unknown type \"wooden\""},
      {polygon("[[[-0.5,50.0],[-0.4,50.0],[-0.4,50.1],[-0.5,50.0]]]", "\"height_m\": -3"),
       "height_m is -3"},
      {feature("Point", "[-0.5,50.0]"), "a point without attribute `kind`"},
      {feature("Point", "[-0.5,50.0]", "\"kind\": \"whale\""), "unknown kind \"whale\""},
      {feature("Point", "[-0.5,150.0]", "\"kind\": \"buoy\""), "latitude 150"},
      {feature("Point", "[-0.5,50.0]", "\"kind\": \"racon\", \"racon\": \"?\""), "racon \"?\""},
      {"{\"type\": \"Feature\", \"properties\": {}, \"geometry\": null}", "has no geometry"},
  };
  for (const Case& one : cases) {
    warnings_.clear();
    const CoastChart chart = load(polygon(kIsland) + "," + one.feature);
    ASSERT_THAT(warnings_, testing::SizeIs(1)) << one.complaint;
    EXPECT_THAT(warnings_[0],
                AllOf(HasSubstr("harbour.geojson: harbour feature 1"), HasSubstr(one.complaint)));
    EXPECT_TRUE(is_land(chart, {50.05, -0.95}));
  }
}

TEST_F(VectorCharts, FilesOfNothingUsableAreRefused) {
  EXPECT_THAT(refusal("not JSON at all"), HasSubstr("harbour.geojson"));
  EXPECT_THAT(refusal("{\"type\": \"FeatureCollection\", \"features\": []}"),
              HasSubstr("no land and no objects"));
  EXPECT_THAT(refusal("{\"type\": \"FeatureCollection\", \"features\": [" + polygon(kIsland)),
              HasSubstr("harbour.geojson"))
      << "cut short";
  EXPECT_THAT(complaint_of([&] { VectorChart::open(folder_ / "none.shp", warnings_); }),
              HasSubstr("none.shp"));
}

TEST_F(VectorCharts, ACutShapefileIsRefusedOrNamed) {
  GDALAllRegister();
  const std::filesystem::path shape = folder_ / "many.shp";
  {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("ESRI Shapefile");
    GDALDatasetUniquePtr dataset(driver->Create(shape.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRLayer* layer = dataset->CreateLayer("many", nullptr, wkbPolygon, nullptr);
    for (int i = 0; i < 10; ++i) {
      OGRPolygon land;
      OGRLinearRing ring;
      ring.addPoint(0.1 * i, 50.0);
      ring.addPoint(0.1 * i, 50.05);
      ring.addPoint(0.1 * i + 0.05, 50.0);
      ring.closeRings();
      land.addRing(&ring);
      OGRFeature one(layer->GetLayerDefn());
      one.SetGeometry(&land);
      ASSERT_EQ(layer->CreateFeature(&one), OGRERR_NONE);
    }
  }
  EXPECT_EQ(VectorChart::open(shape, warnings_).load({50.0, 0.5}, metres(2e5)).rings.size(), 10u);
  EXPECT_THAT(warnings_, testing::ElementsAre(HasSubstr("states no reference system")));
  const std::vector<std::uint8_t> whole = bytes_of(shape);
  for (std::size_t size = 0; size < whole.size(); size += 40) {
    write_bytes(shape, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    warnings_.clear();
    const std::string complaint = complaint_of([&] { VectorChart::open(shape, warnings_); });
    EXPECT_TRUE(!complaint.empty() || warnings_.size() > 1) << size << " bytes without a word";
  }
}

TEST_F(VectorCharts, CutsAtTheAntimeridianAreNoShore) {
  const CoastChart chart = load(
      feature("MultiPolygon",
              "[[[[179.0,-17.0],[180.0,-17.0],[180.0,-16.0],[179.0,-16.0],[179.0,-17.0]]],"
              "[[[-180.0,-17.0],[-179.0,-17.0],[-179.0,-16.0],[-180.0,-16.0],[-180.0,-17.0]]]]"),
      {-16.5, 180.0});
  int borders = 0;
  for (const CoastRing& ring : chart.rings)
    borders +=
        static_cast<int>(std::count(ring.edges.begin(), ring.edges.end(), EdgeKind::bin_border));
  EXPECT_EQ(borders, 2);
  for (const double longitude : {179.5, 180.0, -179.5})
    EXPECT_EQ(winding_number(chart, {-16.5, longitude}), 1) << longitude;
  EXPECT_EQ(winding_number(chart, {-16.5, 178.5}), 0);
}

TEST_F(VectorCharts, LandAroundAPole) {
  const CoastChart chart = load(
      polygon("[[[-180,-90],[180,-90],[180,-75],[60,-70],[-60,-72],[-180,-75],[-180,-90]]]") + "," +
          polygon("[[[-180,90],[-180,80],[-60,82],[60,82],[180,80],[180,90],[-180,90]]]"),
      {0.0, 0.0});
  EXPECT_THAT(warnings_, IsEmpty());
  for (const double longitude : {-179.0, -60.0, 0.0, 60.0, 179.0}) {
    CoastChart whole = VectorChart::open(file_, warnings_).load({0, 0}, metres(2.1e7));
    EXPECT_TRUE(is_land(whole, {-80.0, longitude})) << longitude;
    EXPECT_TRUE(is_land(whole, {85.0, longitude})) << longitude;
    EXPECT_FALSE(is_land(whole, {-60.0, longitude})) << longitude;
    EXPECT_FALSE(is_land(whole, {70.0, longitude})) << longitude;
  }
}

TEST_F(VectorCharts, LandEndsInASeamAtADeclaredCoverage) {
  const VectorChart chart =
      open(polygon(kIsland) + "," +
           polygon("[[[-1.0,49.9],[-0.5,49.9],[-0.5,50.5],[-1.0,50.5],[-1.0,49.9]]]",
                   "\"kind\": \"coverage\""));
  const CoastChart window = chart.load({50.0, -1.0}, metres(100000));
  ASSERT_EQ(window.rings.size(), 1u);
  EXPECT_EQ(std::count(window.rings[0].edges.begin(), window.rings[0].edges.end(), EdgeKind::seam),
            1);
  EXPECT_TRUE(chart.coverage().contains({50.3, -0.7}));
  EXPECT_FALSE(chart.coverage().contains({50.3, -1.1}));
}

TEST_F(VectorCharts, WithoutADeclaredCoverageItIsTheBoxAround) {
  const VectorChart chart = open(polygon(kIsland));
  EXPECT_TRUE(chart.coverage().contains({50.1004, -0.8996}));
  EXPECT_FALSE(chart.coverage().contains({50.1006, -0.95}));
  const CoastRing ring = chart.load({50.0, -1.0}, metres(100000)).rings.at(0);
  EXPECT_EQ(std::count(ring.edges.begin(), ring.edges.end(), EdgeKind::shoreline), 4);
}

TEST_F(VectorCharts, AWindowHoldsWholeRingsThatReachIntoItAndNoOthers) {
  const VectorChart chart =
      open(polygon(kIsland) + "," + polygon("[[[3.0,50.0],[3.1,50.0],[3.1,50.1],[3.0,50.0]]]") +
           "," + feature("Point", "[3.05,50.2]", "\"kind\": \"buoy\""));
  EXPECT_EQ(chart.load({50.0, -1.05}, metres(5000)).rings.size(), 1u);
  EXPECT_EQ(chart.load({50.0, -1.05}, metres(5000)).objects.size(), 0u);
  EXPECT_EQ(chart.load({50.0, 2.9}, metres(50000)).rings.size(), 1u);
  EXPECT_EQ(chart.load({50.0, 2.9}, metres(50000)).objects.size(), 1u);
  EXPECT_EQ(chart.load({50.0, 1.0}, metres(300000)).rings.size(), 2u);
  EXPECT_THROW(chart.load({95.0, 1.0}, metres(1000)), std::invalid_argument);
  EXPECT_THROW(chart.load({50.0, 1.0}, metres(-1)), std::invalid_argument);
  EXPECT_THROW(chart.load({50.0, std::nan("")}, metres(1)), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::echo
