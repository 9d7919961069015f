#include "echo/chart/gshhg_grid.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>

namespace skerry::echo {
namespace {

constexpr std::uint16_t kFar = 65535;

double metres_between(GeoPoint a, GeoPoint b) {
  double s = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, s);
  return s;
}

TEST(GshhgGrid, CountsBinsFromTheNorthPoleAndGreenwich) {
  const GshhgGrid grid(60);
  EXPECT_EQ(grid.bin_count(), 64800);
  EXPECT_EQ(grid.position(0, {0, kFar}), (GeoPoint{90.0, 0.0}));
  EXPECT_EQ(grid.position(29 * 360 + 5, {0, 0}), (GeoPoint{60.0, 5.0}));
  EXPECT_EQ(grid.position(64799, {kFar, 0}), (GeoPoint{-90.0, 0.0}));
  EXPECT_EQ(grid.position(180, {0, kFar}), (GeoPoint{90.0, -180.0}));
  EXPECT_EQ(grid.position(179, {kFar, kFar}), (GeoPoint{90.0, -180.0}));
}

// All four sides of every bin, at places spread over the side.
TEST(GshhgGrid, APlaceOnABorderIsTheSameInBothBins) {
  for (const int minutes : {60, 120, 300, 600, 1200}) {
    const GshhgGrid grid(minutes);
    for (int bin = 0; bin < grid.bin_count(); ++bin) {
      const int row = bin / grid.columns(), column = bin % grid.columns();
      const int east = row * grid.columns() + (column + 1) % grid.columns();
      for (const int at : {0, 1, 21845, 40000, 65534, 65535}) {
        const auto u = static_cast<std::uint16_t>(at);
        ASSERT_EQ(grid.position(bin, {kFar, u}), grid.position(east, {0, u}));
        ASSERT_EQ(grid.identity(bin, {kFar, u}), grid.identity(east, {0, u}));
        if (row + 1 == grid.rows()) continue;
        const int south = bin + grid.columns();
        ASSERT_EQ(grid.position(bin, {u, 0}), grid.position(south, {u, kFar}));
        ASSERT_EQ(grid.identity(bin, {u, 0}), grid.identity(south, {u, kFar}));
      }
    }
  }
}

TEST(GshhgGrid, EachPoleHasOneIdentityAndOtherPlacesTheirOwn) {
  const GshhgGrid grid(300);
  std::set<std::uint64_t> north, all;
  for (int column = 0; column < grid.columns(); ++column) {
    north.insert(grid.identity(column, {100, kFar}));
    for (const int at : {0, 7, 65534}) {
      all.insert(grid.identity(column, {static_cast<std::uint16_t>(at), 100}));
    }
  }
  EXPECT_EQ(north.size(), 1u);
  EXPECT_EQ(all.size(), 3u * static_cast<unsigned>(grid.columns()));
}

TEST(GshhgGrid, EveryBinWithAPlaceInTheCircleIsFound) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double least = 1e9;
  for (int round = 0; round < 100; ++round) {
    const GshhgGrid grid(round % 2 == 0 ? 60 : 300);
    GeoPoint centre{std::asin(2.0 * unit(random) - 1.0) * 57.29577951308232,
                    360.0 * unit(random) - 180.0};
    if (round % 10 == 1) centre.latitude_deg = 90.0;
    if (round % 10 == 2) centre.latitude_deg = -89.7;
    if (round % 10 == 3) centre.longitude_deg = -180.0;
    if (round % 10 == 4) centre = {std::round(centre.latitude_deg), 0.0};
    const double radius = 400e3 * unit(random);
    std::set<int> found;
    for (const BinRun run : grid.bins_within(centre, radius)) {
      EXPECT_EQ(run.first / grid.columns(), (run.first + run.count - 1) / grid.columns());
      for (int b = run.first; b < run.first + run.count; ++b) EXPECT_TRUE(found.insert(b).second);
    }
    for (int i = 0; i < 200; ++i) {
      GeoPoint p;
      GeographicLib::Geodesic::WGS84().Direct(
          centre.latitude_deg, centre.longitude_deg, 360.0 * unit(random),
          radius * std::sqrt(unit(random)), p.latitude_deg, p.longitude_deg);
      const double bin_degrees = grid.bin_minutes() / 60.0;
      const int row =
          std::min(grid.rows() - 1, static_cast<int>((90.0 - p.latitude_deg) / bin_degrees));
      const double east = p.longitude_deg < 0.0 ? p.longitude_deg + 360.0 : p.longitude_deg;
      const int column = static_cast<int>(east / bin_degrees) % grid.columns();
      ASSERT_TRUE(found.count(row * grid.columns() + column))
          << p.latitude_deg << ", " << p.longitude_deg;
    }
    // And none that is far outside: the nearest corner or side is within 1.2 % of the radius.
    for (const int bin : found) {
      double nearest = 1e12;
      for (int k = 0; k <= 64; ++k) {
        const auto u = static_cast<std::uint16_t>(k * 65535 / 64);
        for (const BinPoint p :
             {BinPoint{u, 0}, BinPoint{u, kFar}, BinPoint{0, u}, BinPoint{kFar, u}})
          nearest = std::min(nearest, metres_between(centre, grid.position(bin, p)));
      }
      const double bound = grid.nearest_metres(centre, bin);
      if (bound == 0.0) continue;
      EXPECT_LE(bound, nearest * (1.0 + 1e-12));
      // The border was sampled every 9 km at most (5 degrees / 64).
      if (nearest > 200e3) least = std::min(least, bound / nearest);
    }
  }
  std::printf("lower bound of distances: %.4f of the geodesic at least\n", least);
  EXPECT_GT(least, 0.985);
}

}  // namespace
}  // namespace skerry::echo
