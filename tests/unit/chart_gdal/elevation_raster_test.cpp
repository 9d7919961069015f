#include "echo/chart/gdal/elevation_raster.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>

#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kNoData = -32768.0f;

// A plane in latitude and longitude, so that any interpolation must find it again.
double hill(double latitude, double longitude) {
  return 100.0 + 200.0 * (latitude - 60.0) + 50.0 * (longitude - 5.0);
}

class Elevation : public testing::Test {
 protected:
  struct Raster {
    const char* name = "hill.tif";
    double west = 5.0, north = 60.5, step = 0.01;
    int columns = 100, rows = 50;
    int epsg = 4326;
    GDALDataType type = GDT_Float32;
    const char* unit = "";
  };
  // Heights by hill() for a geographic raster; a hole of no data at row 10, column 20.
  std::filesystem::path make(const Raster& raster) {
    GDALAllRegister();
    const std::filesystem::path file = folder_ / raster.name;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDatasetUniquePtr dataset(
        driver->Create(file.c_str(), raster.columns, raster.rows, 1, raster.type, nullptr));
    double place[6] = {raster.west, raster.step, 0.0, raster.north, 0.0, -raster.step};
    EXPECT_EQ(dataset->SetGeoTransform(place), CE_None);
    if (raster.epsg != 0) {
      OGRSpatialReference srs;
      EXPECT_EQ(srs.importFromEPSG(raster.epsg), OGRERR_NONE);
      EXPECT_EQ(dataset->SetSpatialRef(&srs), CE_None);
    }
    GDALRasterBand* band = dataset->GetRasterBand(1);
    band->SetNoDataValue(static_cast<double>(kNoData));
    if (raster.unit[0] != '\0') band->SetUnitType(raster.unit);
    std::vector<float> heights(static_cast<std::size_t>(raster.columns * raster.rows));
    for (int r = 0; r < raster.rows; ++r) {
      for (int c = 0; c < raster.columns; ++c) {
        const double y = raster.north - (r + 0.5) * raster.step;
        const double x = raster.west + (c + 0.5) * raster.step;
        const bool geographic = raster.epsg == 4326 || raster.epsg == 0;
        heights[static_cast<std::size_t>(r * raster.columns + c)] =
            static_cast<float>(geographic ? hill(y, x) : 1e-4 * (y - 6.6e6) + 2e-4 * x);
      }
    }
    if (raster.rows > 10 && raster.columns > 20)
      heights[static_cast<std::size_t>(10 * raster.columns + 20)] = kNoData;
    EXPECT_EQ(band->RasterIO(GF_Write, 0, 0, raster.columns, raster.rows, heights.data(),
                             raster.columns, raster.rows, GDT_Float32, 0, 0, nullptr),
              CE_None);
    return file;
  }
  ElevationRaster open(const std::filesystem::path& file) {
    return ElevationRaster::open(file, warnings_);
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(Elevation, HeightsAreWhereTheyWere) {
  const auto grid = open(make({})).load({60.25, 5.5}, metres(100000));
  ASSERT_TRUE(grid);
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(grid->columns, 100);
  EXPECT_EQ(grid->rows, 50);
  for (double latitude = 60.02; latitude < 60.38; latitude += 0.037) {
    for (double longitude = 5.02; longitude < 5.98; longitude += 0.041)
      EXPECT_NEAR(grid->at({latitude, longitude}), hill(latitude, longitude), 1e-3);
  }
  EXPECT_TRUE(std::isnan(grid->at({60.395, 5.205}))) << "no data";
  EXPECT_TRUE(std::isnan(grid->at({60.6, 5.5}))) << "outside";
}

TEST_F(Elevation, AWindowIsReadAndNoMore) {
  const ElevationRaster raster = open(make({}));
  const auto grid = raster.load({60.25, 5.5}, metres(5000));
  ASSERT_TRUE(grid);
  EXPECT_LT(grid->columns, 30);
  EXPECT_LT(grid->rows, 20);
  EXPECT_NEAR(grid->at({60.25, 5.5}), hill(60.25, 5.5), 1e-3);
  EXPECT_NEAR(grid->at({60.22, 5.45}), hill(60.22, 5.45), 1e-3);
  EXPECT_EQ(raster.load({10.0, 5.5}, metres(5000)), nullptr);
  EXPECT_EQ(raster.load({60.25, -170.0}, metres(5000)), nullptr);
}

TEST_F(Elevation, AProjectedRasterIsBroughtToLatitudeAndLongitude) {
  // 20 km of UTM zone 32 N around 9 E, 60 N.
  const auto grid = open(make({.name = "utm.tif",
                               .west = 490000.0,
                               .north = 6661000.0,
                               .step = 100.0,
                               .columns = 200,
                               .rows = 200,
                               .epsg = 32632}))
                        .load({60.0, 9.0}, metres(5000));
  ASSERT_TRUE(grid);
  OGRSpatialReference utm, wgs84;
  utm.importFromEPSG(32632);
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  std::unique_ptr<OGRCoordinateTransformation> to_utm(
      OGRCreateCoordinateTransformation(&wgs84, &utm));
  for (const GeoPoint p : {GeoPoint{60.0, 9.0}, GeoPoint{60.02, 9.05}, GeoPoint{59.98, 8.93}}) {
    double x = p.longitude_deg, y = p.latitude_deg;
    ASSERT_TRUE(to_utm->Transform(1, &x, &y));
    EXPECT_NEAR(grid->at(p), 1e-4 * (y - 6.6e6) + 2e-4 * x, 0.02);
  }
}

TEST_F(Elevation, ALargeRasterIsThinned) {
  const auto grid = open(make({.name = "large.tif",
                               .west = 5.0,
                               .north = 61.0,
                               .step = 0.0002,
                               .columns = 5000,
                               .rows = 4800}))
                        .load({60.5, 5.5}, metres(200000));
  ASSERT_TRUE(grid);
  EXPECT_LE(static_cast<std::int64_t>(grid->columns) * grid->rows, ElevationRaster::kMostPosts);
  EXPECT_GT(static_cast<std::int64_t>(grid->columns) * grid->rows, ElevationRaster::kMostPosts / 2);
  for (const double latitude : {60.1, 60.5, 60.9})
    EXPECT_NEAR(grid->at({latitude, 5.7}), hill(latitude, 5.7), 0.1);
}

TEST_F(Elevation, FeetAreBroughtToMetres) {
  const auto grid = open(make({.unit = "ft"})).load({60.25, 5.5}, metres(5000));
  ASSERT_TRUE(grid);
  EXPECT_NEAR(grid->at({60.25, 5.5}), 0.3048 * hill(60.25, 5.5), 1e-3);
}

TEST_F(Elevation, TilesOfADirectoryLieSideBySide) {
  make({.name = "west.tif", .west = 5.0});
  make({.name = "east.tif", .west = 6.0});
  const auto grid = open(folder_.path()).load({60.25, 6.0}, metres(20000));
  ASSERT_TRUE(grid);
  for (const double longitude : {5.9, 5.9961, 6.0, 6.004, 6.1})
    EXPECT_NEAR(grid->at({60.25, longitude}), hill(60.25, longitude), 2e-3) << longitude;
}

TEST_F(Elevation, SrtmTiles) {
  // 1201 x 1201 posts of 3 seconds, big-endian, north row first, void -32768.
  std::vector<std::uint8_t> bytes;
  for (int r = 0; r < 1201; ++r) {
    for (int c = 0; c < 1201; ++c) {
      const int height = r == 600 && c == 600 ? -32768 : 1200 - r + c / 2;
      bytes.push_back(static_cast<std::uint8_t>((height >> 8) & 0xFF));
      bytes.push_back(static_cast<std::uint8_t>(height & 0xFF));
    }
  }
  const std::filesystem::path file = folder_ / "N60E005.hgt";
  write_bytes(file, bytes);
  const auto grid = open(file).load({60.5, 5.5}, metres(100000));
  ASSERT_TRUE(grid);
  EXPECT_NEAR(grid->at({60.0 + 100 / 1200.0, 5.0 + 200 / 1200.0}), 200.0, 0.51);
  EXPECT_NEAR(grid->at({60.0 + 900 / 1200.0, 5.0 + 1000 / 1200.0}), 1400.0, 0.51);
  EXPECT_TRUE(std::isnan(grid->at({60.5, 5.5})));
}

TEST_F(Elevation, WhatIsNoRasterOnTheEarthIsRefused) {
  write_text(folder_ / "text.tif", "these are no heights");
  EXPECT_THAT(complaint_of([&] { open(folder_ / "text.tif"); }), HasSubstr("text.tif"));
  EXPECT_THAT(complaint_of([&] { open(folder_ / "none.tif"); }), HasSubstr("none.tif"));
  EXPECT_THAT(complaint_of([&] { open(make({.name = "nowhere.tif", .epsg = 0})); }),
              HasSubstr("states no place"));
  EXPECT_THAT(
      complaint_of([&] { open(make({.name = "off.tif", .west = 5000.0, .north = 900.0})); }),
      HasSubstr("off.tif"));
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_THAT(complaint_of([&] { open(folder_ / "empty"); }), HasSubstr("no .tif"));
}

TEST_F(Elevation, ACutFileIsRefusedAndNothingHalfIsHandedOut) {
  const std::filesystem::path file = make({});
  const std::vector<std::uint8_t> whole = bytes_of(file);
  for (std::size_t size = 0; size < whole.size(); size += 997) {
    write_bytes(file, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_NE(complaint_of([&] {
                (void)open(file).load({60.25, 5.5}, metres(100000));
              }),
              "")
        << size << " of " << whole.size();
  }
}

}  // namespace
}  // namespace skerry::echo
