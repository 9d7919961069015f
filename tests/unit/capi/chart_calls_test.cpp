#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

// A square of a tenth of a degree, and a lake in its middle.
const std::vector<skerry_echo_position> kSquareWithLake = {
    {60.0, 5.0},   {60.0, 5.1},   {60.1, 5.1},   {60.1, 5.0},
    {60.04, 5.04}, {60.06, 5.04}, {60.06, 5.06}, {60.04, 5.06}};
const std::vector<std::size_t> kTwoRings = {4, 4};

Chart square_with_lake() {
  Chart chart;
  EXPECT_OK(skerry_echo_chart_from_rings(kSquareWithLake.data(), 8, kTwoRings.data(), nullptr, 2,
                                         chart.out()));
  return chart;
}

int32_t is_land(skerry_echo_chart* chart, double latitude, double longitude) {
  int32_t land = -1;
  EXPECT_OK(skerry_echo_chart_is_land(chart, latitude, longitude, &land));
  return land;
}

TEST(CChart, KnowsLandFromWaterAnywhere) {
  const Chart chart = square_with_lake();
  EXPECT_EQ(is_land(chart, 60.02, 5.02), 1);
  EXPECT_EQ(is_land(chart, 60.05, 5.05), 0) << "in the lake";
  EXPECT_EQ(is_land(chart, 60.05, 5.07), 1);
  EXPECT_EQ(is_land(chart, 60.05, 5.11), 0);
  EXPECT_EQ(is_land(chart, -60.05, -174.95), 0) << "at the other end of the Earth";
  for (const double latitude : {-90.0, 90.0}) EXPECT_EQ(is_land(chart, latitude, 180.0), 0);
  EXPECT_EQ(is_land(chart, 60.02, 5.02), 1);
}

TEST(CChart, OpensTheInstalledWorld) {
  if (!world_installed()) GTEST_SKIP() << "no GSHHG chart installed (Debian: gmt-gshhg-full)";
  Chart chart;
  ASSERT_OK(open_chart("", chart));
  EXPECT_EQ(is_land(chart, 60.35, 5.45), 1) << "inland of Bergen";
  EXPECT_EQ(is_land(chart, kAfloat.latitude_deg, kAfloat.longitude_deg), 0);
  EXPECT_EQ(is_land(chart, 0.0, -30.0), 0);
  EXPECT_EQ(is_land(chart, -16.85, -179.97), 1) << "Taveuni, on the antimeridian";
}

TEST(CChart, SaysItsNameInTwoCalls) {
  const Chart chart = square_with_lake();
  std::size_t size = 0;
  ASSERT_OK(skerry_echo_chart_describe(chart, nullptr, 0, &size));
  ASSERT_EQ(size, std::strlen("2 rings") + 1);
  std::string text(size + 1, '#');
  size = 0;
  EXPECT_REFUSED(skerry_echo_chart_describe(chart, text.data(), 7, &size), SKERRY_ECHO_ERROR_SIZE,
                 "7 of 8");
  EXPECT_EQ(size, 8u);
  EXPECT_EQ(text, std::string(9, '#'));
  ASSERT_OK(skerry_echo_chart_describe(chart, text.data(), 8, &size));
  EXPECT_EQ(text, std::string("2 rings\0#", 9));
  EXPECT_REFUSED(skerry_echo_chart_describe(chart, text.data(), 8, nullptr),
                 SKERRY_ECHO_ERROR_ARGUMENT, "the count is NULL");
  EXPECT_REFUSED(skerry_echo_chart_describe(chart, nullptr, 8, &size), SKERRY_ECHO_ERROR_ARGUMENT,
                 "out is NULL");
  ASSERT_OK(skerry_echo_chart_warnings(chart, text.data(), text.size(), &size));
  EXPECT_EQ(size, 1u);
  EXPECT_EQ(text[0], '\0') << "nothing to warn of";
}

TEST(CChart, RefusesFilesItCannotRead) {
  Chart chart;
  const std::string folder = testing::TempDir();
  for (const char* name : {"no-such-chart.nc", "no-such-cell.000", "no-such.geojson", "no-such"}) {
    EXPECT_REFUSED(open_chart(folder + "/" + name, chart), SKERRY_ECHO_ERROR_CHART, name);
  }
  for (const char* name : {"capi-junk.nc", "CAPIJUNK.000", "capi-junk.geojson", "capi-junk.shp"}) {
    const std::string junk = folder + "/" + name;
    std::ofstream(junk) << "CDF\001 but nothing behind";
    EXPECT_REFUSED(open_chart(junk, chart), SKERRY_ECHO_ERROR_CHART, name);
    std::filesystem::remove(junk);
  }
  EXPECT_EQ(static_cast<skerry_echo_chart*>(chart), nullptr);
}

TEST(CChart, RefusesBadListsOfFiles) {
  Chart chart;
  const char* const none[] = {"", nullptr};
  const auto open = [&](const char* const* paths, std::size_t count, const char* const* elevations,
                        std::size_t elevation_count, skerry_echo_chart** out) {
    return skerry_echo_chart_open(paths, count, elevations, elevation_count, out);
  };
  const int32_t code = SKERRY_ECHO_ERROR_ARGUMENT;
  EXPECT_REFUSED(open(none, 2, nullptr, 0, chart.out()), code, "paths[1]: the path is NULL");
  EXPECT_REFUSED(open(none, 1, none, 2, chart.out()), code, "elevations[1]: the path is NULL");
  EXPECT_REFUSED(open(nullptr, 1, nullptr, 0, chart.out()), code, "paths is NULL");
  EXPECT_REFUSED(open(none, 1, nullptr, 1, chart.out()), code, "elevations is NULL");
  EXPECT_REFUSED(open(none, 1, nullptr, 0, nullptr), code, "chart is NULL");
  for (const std::size_t bad : {std::size_t{0}, std::size_t{1025}, SIZE_MAX}) {
    EXPECT_REFUSED(open(none, bad, nullptr, 0, chart.out()), code, "1 to 1024");
  }
  for (const std::size_t bad : {std::size_t{65}, SIZE_MAX}) {
    EXPECT_REFUSED(open(none, 1, none, bad, chart.out()), code, "0 to 64");
  }
}

// A square island of land as GeoJSON, and what cannot be one beside it.
TEST(CChart, OpensGeoJsonAndSaysWhatOfItCannotBeUsed) {
  const std::string file = testing::TempDir() + "/capi-island.geojson";
  const auto polygon = [](const char* corners) {
    return std::string(R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon",)") +
           R"("coordinates":[[)" + corners + "]]}}";
  };
  std::ofstream(file) << R"({"type":"FeatureCollection","features":[)"
                      << polygon("[5.0,60.0],[5.1,60.0],[5.1,60.1],[5.0,60.1],[5.0,60.0]") << ","
                      << polygon("[5.3,60.0],[5.4,60.0],[5.3,60.0]") << "]}";
  Chart chart;
  ASSERT_OK(open_chart(file, chart));
  EXPECT_EQ(is_land(chart, 60.05, 5.05), 1);
  EXPECT_EQ(is_land(chart, 60.05, 5.15), 0);
  std::size_t size = 0;
  ASSERT_OK(skerry_echo_chart_warnings(chart, nullptr, 0, &size));
  std::string text(size, '#');
  ASSERT_OK(skerry_echo_chart_warnings(chart, text.data(), text.size(), &size));
  EXPECT_THAT(text, testing::HasSubstr("capi-island.geojson"));

  const char* const paths[] = {file.c_str()};
  const char* const elevations[] = {"no-such-heights.tif"};
  Chart none;
  EXPECT_REFUSED(skerry_echo_chart_open(paths, 1, elevations, 1, none.out()),
                 SKERRY_ECHO_ERROR_CHART, "no-such-heights.tif");
  std::filesystem::remove(file);
}

TEST(CChart, RefusesRingsThatBoundNothing) {
  Chart chart;
  auto vertices = kSquareWithLake;
  auto sizes = kTwoRings;
  std::vector<int32_t> types = {SKERRY_ECHO_COAST_ROCKY, SKERRY_ECHO_COAST_SANDY};
  const auto make = [&] {
    return skerry_echo_chart_from_rings(vertices.data(), vertices.size(), sizes.data(),
                                        types.data(), sizes.size(), chart.out());
  };
  for (const double latitude : {90.1, -91.0, kNaN, kInfinity}) {
    vertices[5].latitude_deg = latitude;
    EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "vertices[5] (ring 1)");
  }
  vertices = kSquareWithLake;
  for (const double longitude : {180.1, -181.0, kNaN, -kInfinity}) {
    vertices[2].longitude_deg = longitude;
    EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "vertices[2] (ring 0)");
  }
  vertices = kSquareWithLake;
  vertices[1] = vertices[2] = vertices[0];  // two different ones are left
  EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "ring 0 has 2 different vertices");
  vertices = kSquareWithLake;
  vertices[6] = {50.0, 5.0};
  EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "ring 1 reaches 111");

  vertices = kSquareWithLake;
  for (const std::vector<std::size_t>& bad :
       {std::vector<std::size_t>{4, 5}, {4, 2}, {4, SIZE_MAX}, {SIZE_MAX, 5}, {0, 8}}) {
    sizes = bad;
    EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "ring_sizes");
  }
  sizes = {4, 3};
  EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_SIZE, "sum of ring_sizes 7");
  sizes = kTwoRings;
  for (const int32_t type : {-1, 4, INT32_MAX}) {
    types[1] = type;
    EXPECT_REFUSED(make(), SKERRY_ECHO_ERROR_ARGUMENT, "ring 1: its ring_types");
  }
  EXPECT_EQ(static_cast<skerry_echo_chart*>(chart), nullptr);
}

TEST(CChart, RefusesBadPointersAndCountsOfRings) {
  Chart chart;
  const auto* v = kSquareWithLake.data();
  const auto* s = kTwoRings.data();
  EXPECT_REFUSED(skerry_echo_chart_from_rings(nullptr, 8, s, nullptr, 2, chart.out()),
                 SKERRY_ECHO_ERROR_ARGUMENT, "vertices is NULL");
  EXPECT_REFUSED(skerry_echo_chart_from_rings(v, 8, nullptr, nullptr, 2, chart.out()),
                 SKERRY_ECHO_ERROR_ARGUMENT, "ring_sizes is NULL");
  EXPECT_REFUSED(skerry_echo_chart_from_rings(v, 8, s, nullptr, 2, nullptr),
                 SKERRY_ECHO_ERROR_ARGUMENT, "chart is NULL");
  EXPECT_REFUSED(skerry_echo_chart_from_rings(v, SIZE_MAX, s, nullptr, 2, chart.out()),
                 SKERRY_ECHO_ERROR_ARGUMENT, "vertex_count");
  EXPECT_REFUSED(skerry_echo_chart_from_rings(v, 8, s, nullptr, SIZE_MAX, chart.out()),
                 SKERRY_ECHO_ERROR_ARGUMENT, "ring_count");
  EXPECT_OK(skerry_echo_chart_from_rings(nullptr, 0, nullptr, nullptr, 0, chart.out()));
  EXPECT_EQ(is_land(chart, 10.0, 10.0), 0) << "open sea";
}

TEST(CChart, RefusesWhatIsNoChart) {
  int32_t land = 7;
  std::size_t size = 7;
  skerry_echo_coast* coast = nullptr;
  const auto refused_everywhere = [&](skerry_echo_chart* chart, const char* word) {
    EXPECT_REFUSED(skerry_echo_chart_is_land(chart, 0.0, 0.0, &land), SKERRY_ECHO_ERROR_HANDLE,
                   word);
    EXPECT_REFUSED(skerry_echo_chart_describe(chart, nullptr, 0, &size), SKERRY_ECHO_ERROR_HANDLE,
                   word);
    EXPECT_REFUSED(skerry_echo_chart_warnings(chart, nullptr, 0, &size), SKERRY_ECHO_ERROR_HANDLE,
                   word);
    EXPECT_REFUSED(skerry_echo_coast_create(chart, 1, &coast), SKERRY_ECHO_ERROR_HANDLE, word);
  };
  for (skerry_echo_chart* chart : no_handles<skerry_echo_chart>()) {
    refused_everywhere(chart, chart ? "no handle" : "NULL");
    EXPECT_EQ(skerry_echo_chart_destroy(chart), chart ? SKERRY_ECHO_ERROR_HANDLE : SKERRY_ECHO_OK);
  }
  skerry_echo_chart* gone = nullptr;
  ASSERT_OK(skerry_echo_chart_from_rings(nullptr, 0, nullptr, nullptr, 0, &gone));
  ASSERT_OK(skerry_echo_chart_destroy(gone));
  refused_everywhere(gone, "destroyed");
  EXPECT_EQ(skerry_echo_chart_destroy(gone), SKERRY_ECHO_ERROR_HANDLE);
  const Chart next = square_with_lake();
  EXPECT_NE(static_cast<skerry_echo_chart*>(next), gone) << "no handle is given out twice";

  const Coast other = coast_of(next);
  refused_everywhere(reinterpret_cast<skerry_echo_chart*>(static_cast<skerry_echo_coast*>(other)),
                     "is the handle of a coast");
  EXPECT_EQ(land, 7);
  EXPECT_EQ(size, 7u);
  EXPECT_EQ(coast, nullptr);
}

TEST(CChart, RefusesPlacesOffTheGlobe) {
  const Chart chart = square_with_lake();
  int32_t land = 7;
  for (const double bad : {90.001, -90.001, kNaN, kInfinity}) {
    EXPECT_REFUSED(skerry_echo_chart_is_land(chart, bad, 0.0, &land), SKERRY_ECHO_ERROR_ARGUMENT,
                   "allowed: -90 to 90");
  }
  for (const double bad : {180.001, -180.001, kNaN, -kInfinity}) {
    EXPECT_REFUSED(skerry_echo_chart_is_land(chart, 0.0, bad, &land), SKERRY_ECHO_ERROR_ARGUMENT,
                   "allowed: -180 to 180");
  }
  EXPECT_EQ(land, 7);
  EXPECT_REFUSED(skerry_echo_chart_is_land(chart, 0.0, 0.0, nullptr), SKERRY_ECHO_ERROR_ARGUMENT,
                 "land is NULL");
}

}  // namespace
}  // namespace skerry::capi_test
