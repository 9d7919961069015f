#include "echo/chart/gshhg_reader.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "echo/chart/land_mask.hpp"

namespace skerry::echo {
namespace {

class GshhgFull : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file = "/usr/share/gmt-gshhg/binned_GSHHS_f.nc";
    if (!std::filesystem::exists(file)) {
      GTEST_SKIP() << "no full-resolution chart; install gmt-gshhg-full";
    }
    reader_.emplace(GshhgReader::open(file));
  }
  std::optional<GshhgReader> reader_;
};

template <typename Visit>
void for_each_shore_edge(const CoastChart& chart, Visit&& visit) {
  for (const CoastRing& ring : chart.rings) {
    const std::size_t n = ring.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (ring.edges[i] == EdgeKind::shoreline) visit(ring, i, j);
    }
  }
}

double length_of(const GeoPoint& a, const GeoPoint& b) {
  double s = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, s);
  return s;
}

struct Box {
  const char* name;
  double west, east, south, north;
  double kilometres, median, mean;  // SOURCES.md "Shorelines"; zero where it states none
};

// Edges whose middle lies in the box, all levels; the sums of SOURCES.md "Shorelines" are cut in
// some such way, hence 3
// %.
TEST_F(GshhgFull, HasTheLengthAndSpacingThatWereMeasuredOnce) {
  for (const Box& box : {Box{"Bergen", 4.6, 5.6, 60.0, 60.6, 1937, 96, 143},
                         Box{"Plymouth", -4.6, -3.6, 50.15, 50.55, 238, 149, 209},
                         Box{"Dalian", 121, 122, 38.7, 39.2, 483, 118, 165}}) {
    const GeoPoint centre{0.5 * (box.south + box.north), 0.5 * (box.west + box.east)};
    const CoastChart chart = reader_->load(centre, metres(60000));
    std::vector<double> lengths;
    for_each_shore_edge(chart, [&](const CoastRing& r, std::size_t i, std::size_t j) {
      const double lat = 0.5 * (r.vertices[i].latitude_deg + r.vertices[j].latitude_deg);
      const double lon = 0.5 * (r.vertices[i].longitude_deg + r.vertices[j].longitude_deg);
      if (lat < box.south || lat > box.north || lon < box.west || lon > box.east) return;
      lengths.push_back(length_of(r.vertices[i], r.vertices[j]));
    });
    std::sort(lengths.begin(), lengths.end());
    double sum = 0.0;
    for (double l : lengths) sum += l;
    const double mean = sum / static_cast<double>(lengths.size());
    std::printf("%s: %.0f km, spacing median %.0f m, mean %.0f m\n", box.name, sum / 1000,
                lengths[lengths.size() / 2], mean);
    EXPECT_NEAR(sum / 1000, box.kilometres, 0.03 * box.kilometres) << box.name;
    EXPECT_NEAR(lengths[lengths.size() / 2], box.median, 0.05 * box.median) << box.name;
    EXPECT_NEAR(mean, box.mean, 0.05 * box.mean) << box.name;
  }
}

struct Place {
  const char* name;
  GeoPoint point;
  bool land;
};

TEST_F(GshhgFull, KnowsLandFromWater) {
  for (const Place& place : {Place{"Ulriken above Bergen", {60.377, 5.387}, true},
                             Place{"Bergen, open sea", {60.3, 4.6}, false},
                             Place{"Sahara", {23.0, 10.0}, true},
                             Place{"mid Pacific", {0.0, -140.0}, false},
                             Place{"Viti Levu", {-17.8, 178.0}, true},
                             Place{"Taveuni west of 180", {-16.85, 179.99}, true},
                             Place{"Koro Sea", {-17.5, 179.6}, false},
                             Place{"Chukotka at 180", {67.5, 179.9}, true},
                             Place{"Chukotka past 180", {67.0, -178.5}, true},
                             Place{"Wrangel Island", {71.2, -179.5}, true},
                             Place{"Svalbard", {79.5, 16.0}, true},
                             Place{"north of Svalbard", {81.5, 16.0}, false},
                             Place{"north pole", {90.0, 0.0}, false},
                             Place{"near the north pole", {89.5, 77.0}, false},
                             Place{"south pole", {-89.9, 0.0}, true},
                             Place{"Ross ice shelf", {-80.5, 180.0 - 360.0}, true},
                             Place{"Ross Sea", {-76.0, -178.0}, false},
                             Place{"Lake Superior", {47.6, -87.5}, false},
                             Place{"Isle Royale in Lake Superior", {48.0, -88.8}, true},
                             Place{"Vaettern", {58.4, 14.6}, false},
                             Place{"Caspian Sea", {42.0, 50.5}, false}}) {
    const CoastChart chart = reader_->load(place.point, metres(20000));
    EXPECT_EQ(is_land(chart, place.point), place.land) << place.name;
  }
}

// Where a shoreline leaves a bin it enters the next at a vertex of the same identity and the same
// bits; only at the rim of the window may it end.
TEST_F(GshhgFull, ShorelinesContinueFromBinToBin) {
  for (const Place& place :
       {Place{"Bergen", {60.3, 5.05}, false}, Place{"Fiji", {-16.75, -179.9}, false},
        Place{"Chukotka", {68.0, 180.0 - 360.0}, false}, Place{"Svalbard", {80.0, 16.0}, false},
        Place{"Antarctica", {-66.5, 100.0}, false}, Place{"Ross Sea", {-77.0, -179.9}, false}}) {
    const CoastChart chart = reader_->load(place.point, metres(180000));
    std::map<std::uint64_t, int> ends;
    std::map<std::uint64_t, GeoPoint> where;
    for_each_shore_edge(chart, [&](const CoastRing& r, std::size_t i, std::size_t j) {
      ++ends[r.vertex_ids[i]];
      --ends[r.vertex_ids[j]];
      for (std::size_t k : {i, j}) {
        const auto [known, fresh] = where.emplace(r.vertex_ids[k], r.vertices[k]);
        ASSERT_EQ(known->second, r.vertices[k]) << place.name;
      }
    });
    int loose = 0, inside = 0;
    for (const auto& [id, balance] : ends) {
      if (balance == 0) continue;
      ++loose;
      const double s = length_of(place.point, where[id]);
      if (s < chart.radius_m) {
        ++inside;
        if (inside < 6)
          std::printf("  loose end at %.5f %.5f\n", where[id].latitude_deg,
                      where[id].longitude_deg);
      }
    }
    std::printf("%s: %zu rings, %zu vertices, %d loose ends, %d of them within the radius\n",
                place.name, chart.rings.size(), where.size(), loose, inside);
    EXPECT_EQ(inside, 0) << place.name;
    EXPECT_GT(where.size(), 100u) << place.name;
  }
}

TEST_F(GshhgFull, LandLiesOnTheLeftOfEveryShoreline) {
  for (const GeoPoint centre :
       {GeoPoint{60.3, 5.05}, GeoPoint{-16.75, -179.9}, GeoPoint{58.4, 14.6}}) {
    const CoastChart chart = reader_->load(centre, metres(15000));
    int tried = 0, wrong = 0;
    for_each_shore_edge(chart, [&](const CoastRing& r, std::size_t i, std::size_t j) {
      if (++tried % 17 != 0) return;
      const GeoPoint &a = r.vertices[i], &b = r.vertices[j];
      const double north = b.latitude_deg - a.latitude_deg;
      const double east = wrapped_longitude(b.longitude_deg - a.longitude_deg);
      // A thousandth of the edge to either side of its middle.
      const auto beside = [&](double k) {
        return GeoPoint{a.latitude_deg + 0.5 * north + k * east,
                        wrapped_longitude(a.longitude_deg + 0.5 * east - k * north)};
      };
      if (!is_land(chart, beside(1e-3)) || is_land(chart, beside(-1e-3))) ++wrong;
    });
    std::printf("%d edges tried, %d wrong\n", tried / 17, wrong);
    EXPECT_GT(tried, 500);
    EXPECT_EQ(wrong, 0);
  }
}

TEST_F(GshhgFull, BinBordersAreMarked) {
  const CoastChart chart = reader_->load({60.3, 5.05}, metres(30000));
  int borders = 0;
  for (const CoastRing& ring : chart.rings) {
    ASSERT_EQ(ring.edges.size(), ring.vertices.size());
    ASSERT_EQ(ring.vertex_ids.size(), ring.vertices.size());
    const std::size_t n = ring.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const GeoPoint &a = ring.vertices[i], &b = ring.vertices[i + 1 == n ? 0 : i + 1];
      const auto whole = [](double x) { return x == std::round(x); };
      const bool on_border = (a.latitude_deg == b.latitude_deg && whole(a.latitude_deg)) ||
                             (a.longitude_deg == b.longitude_deg && whole(a.longitude_deg));
      EXPECT_EQ(ring.edges[i] == EdgeKind::bin_border, on_border);
      borders += on_border;
    }
  }
  EXPECT_GT(borders, 10);
}

TEST_F(GshhgFull, TheSameVertexHasTheSameIdentityInEveryWindow) {
  const CoastChart one = reader_->load({60.3, 5.05}, metres(20000));
  const CoastChart two = reader_->load({60.35, 5.4}, metres(90000));
  std::set<std::uint64_t> ids;
  for (const CoastRing& r : two.rings) ids.insert(r.vertex_ids.begin(), r.vertex_ids.end());
  for (const CoastRing& r : one.rings) {
    for (std::uint64_t id : r.vertex_ids) ASSERT_TRUE(ids.count(id));
  }
}

TEST(Gshhg, EveryInstalledResolutionKnowsTheSeaFromTheLand) {
  int found = 0;
  for (const char* resolution : {"c", "l", "i", "h", "f"}) {
    const std::filesystem::path file =
        std::string("/usr/share/gmt-gshhg/binned_GSHHS_") + resolution + ".nc";
    if (!std::filesystem::exists(file)) continue;
    ++found;
    const GshhgReader reader = GshhgReader::open(file);
    EXPECT_TRUE(is_land(reader.load({48.8, 2.3}, metres(5000)), {48.8, 2.3})) << file;
    EXPECT_FALSE(is_land(reader.load({45.0, -20.0}, metres(5000)), {45.0, -20.0})) << file;
    EXPECT_FALSE(is_land(reader.load({35.0, 179.99}, metres(500000)), {35.0, 179.99})) << file;
    EXPECT_TRUE(is_land(reader.load({-85.0, 40.0}, metres(900000)), {-85.0, 40.0})) << file;
  }
  if (found == 0) GTEST_SKIP() << "no chart installed";
}

}  // namespace
}  // namespace skerry::echo
