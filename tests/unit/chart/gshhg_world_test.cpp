// The whole of an installed chart against what else the file says of itself.
#include <gtest/gtest.h>
#include <netcdf.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "echo/chart/gshhg_file.hpp"
#include "echo/chart/gshhg_reader.hpp"
#include "echo/chart/land_mask.hpp"

namespace skerry::echo {
namespace {

std::optional<std::filesystem::path> installed(char detail) {
  const std::filesystem::path file =
      std::string("/usr/share/gmt-gshhg/binned_GSHHS_") + detail + ".nc";
  return std::filesystem::exists(file) ? std::optional(file) : std::nullopt;
}

// Area between the equator and a latitude, per radian of longitude, km2 on WGS-84.
double zone(double latitude_deg) {
  constexpr double kA = 6378.137, kE2 = 0.00669437999014132;
  const double e = std::sqrt(kE2), s = std::sin(latitude_deg * 3.14159265358979323846 / 180.0);
  return 0.5 * kA * kA * (1.0 - kE2) * (s / (1.0 - kE2 * s * s) + std::atanh(e * s) / e);
}

// Signed, positive counter-clockwise; edges straight in longitude against zone().
double area_km2(const CoastRing& ring) {
  double sum = 0.0;
  for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
    const GeoPoint a = ring.vertices[i], b = ring.vertices[i + 1 == n ? 0 : i + 1];
    const double east = wrapped_longitude(b.longitude_deg - a.longitude_deg);
    sum -= east * 0.5 * (zone(a.latitude_deg) + zone(b.latitude_deg));
  }
  return sum * 3.14159265358979323846 / 180.0;
}

CoastRing laid(const GshhgGrid& grid, int bin, const BinRing& ring) {
  CoastRing out;
  for (const BinPoint p : ring.points) out.vertices.push_back(grid.position(bin, p));
  return out;
}

// In the bin's own units, exact.
std::int64_t twice_area(const BinRing& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0, n = ring.points.size(); i < n; ++i) {
    const BinPoint a = ring.points[i], b = ring.points[i + 1 == n ? 0 : i + 1];
    sum += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  return sum;
}

// Depth of each level: land, ice front and grounding line are alike.
int depth_of(std::uint8_t level) { return level >= 5 ? 1 : level; }

template <typename T>
std::vector<T> variable(const std::filesystem::path& file, const char* name) {
  int nc = -1, var = -1, dim = -1;
  std::size_t length = 0;
  EXPECT_EQ(nc_open(file.c_str(), NC_NOWRITE, &nc), NC_NOERR);
  EXPECT_EQ(nc_inq_varid(nc, name, &var), NC_NOERR) << name;
  nc_inq_vardimid(nc, var, &dim);
  nc_inq_dimlen(nc, dim, &length);
  std::vector<T> values(length);
  nc_get_var(nc, var, values.data());
  nc_close(nc);
  return values;
}

// Independent of how rings are made: a corner of a bin lies inside as many rings as have it for a
// vertex, and the file says how many that must be.
TEST(GshhgWorld, EveryBinHasTheCornersItsFileStates) {
  int files = 0;
  for (const char detail : {'c', 'l', 'i', 'h', 'f'}) {
    const auto path = installed(detail);
    if (!path) continue;
    ++files;
    const GshhgFile file(*path);
    const GshhgGrid& grid = file.grid();
    int wrong = 0, wrong_way = 0;
    for (int row = 0; row < grid.rows(); ++row) {
      for (const BinShore& shore : file.read({row * grid.columns(), grid.columns()})) {
        std::array<int, 4> depth{};
        for (const BinRing& ring : assemble_bin(shore, false)) {
          constexpr BinPoint kCorners[4] = {{0, 0}, {65535, 0}, {65535, 65535}, {0, 65535}};
          for (int k = 0; k < 4; ++k)
            depth[k] +=
                std::find(ring.points.begin(), ring.points.end(), kCorners[k]) != ring.points.end();
          const bool land = depth_of(ring.level) % 2 == 1;
          wrong_way += (twice_area(ring) > 0) != land;
        }
        for (int k = 0; k < 4; ++k) wrong += depth[k] != shore.corner_levels[k];
      }
    }
    std::printf("%s: %d bins, %d corners wrong, %d rings the wrong way round\n",
                file.source().c_str(), grid.bin_count(), wrong, wrong_way);
    EXPECT_EQ(wrong, 0) << detail;
    EXPECT_EQ(wrong_way, 0) << detail;
  }
  if (files == 0) GTEST_SKIP() << "no chart installed; apt-get install gmt-gshhg-full";
}

// The file states the area of each polygon, measured before it was cut into bins.
TEST(GshhgWorld, TheAreasOfAllRingsSumUpToThoseOfThePolygons) {
  const auto path = installed('f');
  if (!path) GTEST_SKIP() << "no full-resolution chart; apt-get install gmt-gshhg-full";
  const auto areas = variable<double>(*path, "The_km_squared_area_of_polygons");
  const auto polygons = variable<std::int32_t>(*path, "Id_of_GSHHS_ID");
  const auto info = variable<std::int32_t>(*path, "Embedded_npts_levels_exit_entry_for_a_segment");
  const auto antarctic = variable<std::int8_t>(*path, "Embedded_ANT_flag");
  std::set<std::pair<int, std::int32_t>> seen;
  std::map<int, double> stated, found;
  for (std::size_t s = 0; s < info.size(); ++s) {
    int level = (info[s] >> 6) & 7;
    if (level == 1 && antarctic[s] != 0) level = 5;
    if (level == 6 || !seen.insert({level, polygons[s]}).second) continue;
    stated[level] += std::abs(areas[polygons[s]]);
  }
  const GshhgFile file(*path);
  const GshhgGrid& grid = file.grid();
  for (int row = 0; row < grid.rows(); ++row) {
    const BinRun run{row * grid.columns(), grid.columns()};
    for (const BinShore& shore : file.read(run)) {
      for (const BinRing& ring : assemble_bin(shore, grid.north_of(shore.bin) <= -60.0))
        found[ring.level] += std::abs(area_km2(laid(grid, shore.bin, ring)));
    }
  }
  for (const auto& [level, area] : stated) {
    std::printf("level %d: %.0f km2 in rings, %.0f km2 stated\n", level, found[level], area);
    EXPECT_NEAR(found[level], area, 2e-3 * area) << "level " << level;
  }
  EXPECT_NEAR(stated[5], 13.94e6, 0.05e6);  // Antarctica with its ice shelves
  EXPECT_EQ(found.size(), stated.size());
}

struct Window {
  const char* name;
  GeoPoint centre;
  double radius_m;
};

class GshhgWindows : public testing::TestWithParam<Window> {
 protected:
  void SetUp() override {
    const auto path = installed('f');
    if (!path) GTEST_SKIP() << "no full-resolution chart; apt-get install gmt-gshhg-full";
    chart_ = GshhgReader::open(*path).load(GetParam().centre, metres(GetParam().radius_m));
  }
  double distance(GeoPoint p) const {
    double s = 0.0;
    const GeoPoint c = GetParam().centre;
    GeographicLib::Geodesic::WGS84().Inverse(c.latitude_deg, c.longitude_deg, p.latitude_deg,
                                             p.longitude_deg, s);
    return s;
  }
  CoastChart chart_;
};

TEST_P(GshhgWindows, ShorelinesEndNowhereWithinTheRadius) {
  using End = std::tuple<std::uint64_t, int>;  // identity and level
  std::map<End, int> balance;
  std::map<std::uint64_t, GeoPoint> where;
  std::size_t shore = 0;
  for (const CoastRing& ring : chart_.rings) {
    const std::size_t n = ring.vertices.size();
    ASSERT_GE(n, 3u);
    ASSERT_EQ(ring.edges.size(), n);
    ASSERT_EQ(ring.vertex_ids.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      ASSERT_NE(ring.vertices[i], ring.vertices[j]);
      ASSERT_LT(std::abs(ring.vertices[i].latitude_deg), 90.000001);
      ASSERT_GE(ring.vertices[i].longitude_deg, -180.0);
      ASSERT_LT(ring.vertices[i].longitude_deg, 180.0);
      if (ring.edges[i] != EdgeKind::shoreline) continue;
      ++shore;
      ++balance[{ring.vertex_ids[i], ring.level}];
      --balance[{ring.vertex_ids[j], ring.level}];
      for (const std::size_t k : {i, j}) {
        const auto [known, fresh] = where.emplace(ring.vertex_ids[k], ring.vertices[k]);
        ASSERT_EQ(known->second, ring.vertices[k]);  // the same bits in every bin
      }
    }
  }
  int at_rim = 0;
  for (const auto& [end, sum] : balance) {
    if (sum == 0) continue;
    ++at_rim;
    const GeoPoint p = where[std::get<0>(end)];
    EXPECT_GT(distance(p), chart_.radius_m) << p.latitude_deg << ", " << p.longitude_deg;
  }
  std::printf("%s: %zu rings, %zu shoreline edges, %d ends at the rim\n", GetParam().name,
              chart_.rings.size(), shore, at_rim);
}

// Winding numbers other than 0 and 1 would mean rings wrongly nested or turned.
TEST_P(GshhgWindows, NoPlaceIsTwiceLand) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int land = 0;
  for (int i = 0; i < 200; ++i) {
    GeoPoint p;
    const GeoPoint c = GetParam().centre;
    GeographicLib::Geodesic::WGS84().Direct(c.latitude_deg, c.longitude_deg, 360.0 * unit(random),
                                            GetParam().radius_m * std::sqrt(unit(random)),
                                            p.latitude_deg, p.longitude_deg);
    // On bin borders and corners too.
    if (i % 4 == 1) p.latitude_deg = std::round(p.latitude_deg);
    if (i % 4 >= 2) p.longitude_deg = std::round(p.longitude_deg);
    if (i % 4 == 3) p.latitude_deg = std::round(p.latitude_deg);
    if (distance(p) > GetParam().radius_m) continue;
    const int winding = winding_number(chart_, p);
    EXPECT_TRUE(winding == 0 || winding == 1)
        << p.latitude_deg << ", " << p.longitude_deg << " winds " << winding;
    land += winding;
  }
  std::printf("%s: %d of 200 places on land\n", GetParam().name, land);
}

TEST_P(GshhgWindows, LandLiesOnTheLeft) {
  std::mt19937_64 random(12);
  int tried = 0, wrong = 0;
  for (int attempt = 0; attempt < 400 && !chart_.rings.empty(); ++attempt) {
    const CoastRing& ring = chart_.rings[random() % chart_.rings.size()];
    const std::size_t i = random() % ring.vertices.size();
    const GeoPoint a = ring.vertices[i], b = ring.vertices[(i + 1) % ring.vertices.size()];
    if (ring.edges[i] != EdgeKind::shoreline) continue;
    const double north = b.latitude_deg - a.latitude_deg;
    const double east = wrapped_longitude(b.longitude_deg - a.longitude_deg);
    const auto beside = [&](double k) {
      return GeoPoint{a.latitude_deg + 0.5 * north + k * east,
                      wrapped_longitude(a.longitude_deg + 0.5 * east - k * north)};
    };
    ++tried;
    wrong +=
        winding_number(chart_, beside(1e-3)) != 1 || winding_number(chart_, beside(-1e-3)) != 0;
  }
  std::printf("%s: %d edges tried, %d wrong\n", GetParam().name, tried, wrong);
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(
    World, GshhgWindows,
    testing::Values(
        Window{"Bergen", {60.39, 5.32}, 50e3}, Window{"Plymouth", {50.33, -4.15}, 50e3},
        Window{"Dalian", {38.9, 121.6}, 50e3}, Window{"FijiWest", {-16.8, 179.9}, 90e3},
        Window{"FijiEast", {-16.8, -179.9}, 90e3}, Window{"Wrangel", {71.0, 180.0}, 250e3},
        Window{"FranzJosef", {80.0, 50.0}, 250e3}, Window{"Svalbard", {80.0, 16.0}, 185e3},
        Window{"Antarctica", {-70.0, 0.0}, 185e3}, Window{"RossSea", {-77.0, -179.9}, 185e3},
        Window{"GreatLakes", {47.0, -84.0}, 185e3},
        Window{"GreenwichAndEquator", {5.0, 0.0}, 185e3}, Window{"NorthPole", {90.0, 0.0}, 900e3},
        Window{"SouthPole", {-90.0, 0.0}, 900e3}),
    [](const auto& window) { return std::string(window.param.name); });

TEST(GshhgReader, AWindowAroundAPoleHasAllLongitudes) {
  const auto path = installed('f');
  if (!path) GTEST_SKIP() << "no full-resolution chart; apt-get install gmt-gshhg-full";
  const GshhgReader reader = GshhgReader::open(*path);
  const CoastChart south = reader.load({-89.5, 70.0}, nautical_miles(100.0));
  for (double longitude = -180.0; longitude < 180.0; longitude += 7.5) {
    EXPECT_TRUE(is_land(south, {-89.2, longitude})) << longitude;
    EXPECT_TRUE(is_land(south, {-90.0, longitude})) << longitude;
  }
  EXPECT_TRUE(reader.load({90.0, 0.0}, nautical_miles(100.0)).rings.empty());
}

TEST(GshhgReader, InlandThereIsNoShorelineAndAtSeaNothing) {
  const auto path = installed('f');
  if (!path) GTEST_SKIP() << "no full-resolution chart; apt-get install gmt-gshhg-full";
  const GshhgReader reader = GshhgReader::open(*path);
  const CoastChart sahara = reader.load({23.0, 10.0}, metres(90e3));
  EXPECT_FALSE(sahara.rings.empty());
  for (const CoastRing& ring : sahara.rings)
    EXPECT_EQ(ring.edges, std::vector<EdgeKind>(4, EdgeKind::bin_border));
  EXPECT_TRUE(reader.load({0.0, -140.0}, metres(90e3)).rings.empty());
}

}  // namespace
}  // namespace skerry::echo
