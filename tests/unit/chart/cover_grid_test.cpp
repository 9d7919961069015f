// Painted covers against the polygons themselves.
#include "echo/chart/cover_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace skerry::echo {
namespace {

std::vector<GeoPoint> square(double south, double west, double size) {
  return {{south, west},
          {south, wrapped_longitude(west + size)},
          {south + size, wrapped_longitude(west + size)},
          {south + size, west}};
}

CoastChart window_of(std::vector<CoverArea> covers, GeoPoint centre = {50.0, -1.0},
                     double radius_m = 20'000.0) {
  CoastChart chart;
  chart.centre = centre;
  chart.radius_m = radius_m;
  chart.covers = std::move(covers);
  return chart;
}

TEST(CoverGrid, IsNothingWhereNoChartTells) {
  EXPECT_EQ(CoverGrid::of(window_of({})), nullptr);
  EXPECT_EQ(CoverGrid::of(window_of({{LandCover::forest, {square(60.0, 5.0, 0.1)}}})), nullptr)
      << "far outside the window";
  EXPECT_EQ(CoverGrid::of(window_of({{LandCover::none, {square(50.0, -1.0, 0.1)}}})), nullptr);
}

TEST(CoverGrid, LaterAreasLieOverEarlierOnesAndHolesAreOpen) {
  const auto grid = CoverGrid::of(window_of({
      {LandCover::forest, {square(50.0, -1.0, 0.1), square(50.04, -0.96, 0.02)}},
      {LandCover::built_up, {square(50.0, -1.0, 0.03)}},
      {LandCover::none, {square(50.08, -1.0, 0.01)}},
  }));
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->at({50.07, -0.93}), LandCover::forest);
  EXPECT_EQ(grid->at({50.05, -0.95}), LandCover::none) << "the hole";
  EXPECT_EQ(grid->at({50.01, -0.99}), LandCover::built_up);
  EXPECT_EQ(grid->at({50.085, -0.995}), LandCover::none) << "taken away";
  EXPECT_EQ(grid->at({49.99, -0.95}), LandCover::none);
  EXPECT_EQ(grid->at({50.05, 179.0}), LandCover::none);
}

TEST(CoverGrid, LiesAcrossTheAntimeridian) {
  for (const double centre : {179.95, -179.95}) {
    const auto grid = CoverGrid::of(
        window_of({{LandCover::marsh, {square(10.0, 179.95, 0.1)}}}, {10.05, centre}));
    ASSERT_NE(grid, nullptr);
    for (const double lon : {179.96, 179.999, -179.999, -179.96, 180.01, -180.01})
      EXPECT_EQ(grid->at({10.05, lon}), LandCover::marsh) << centre << " " << lon;
    EXPECT_EQ(grid->at({10.05, 179.94}), LandCover::none);
    EXPECT_EQ(grid->at({10.05, -179.94}), LandCover::none);
  }
}

// A star against even-odd crossings of its own edges; only cells on its outline may differ.
TEST(CoverGrid, ACellHasTheCoverOfItsMiddle) {
  std::mt19937 random(3);
  std::vector<GeoPoint> star;
  for (int i = 0; i < 60; ++i) {
    const double r = std::uniform_real_distribution<>(0.01, 0.08)(random);
    star.push_back({50.0 + r * std::sin(i * M_PI / 30), -1.0 + r * std::cos(i * M_PI / 30)});
  }
  const auto inside = [&](GeoPoint p) {
    bool in = false;
    for (std::size_t i = 0; i < star.size(); ++i) {
      const GeoPoint a = star[i], b = star[(i + 1) % star.size()];
      if ((a.latitude_deg > p.latitude_deg) != (b.latitude_deg > p.latitude_deg) &&
          p.longitude_deg < a.longitude_deg + (b.longitude_deg - a.longitude_deg) *
                                                  (p.latitude_deg - a.latitude_deg) /
                                                  (b.latitude_deg - a.latitude_deg))
        in = !in;
    }
    return in;
  };
  const auto grid = CoverGrid::of(window_of({{LandCover::scrub, {star}}}));
  ASSERT_NE(grid, nullptr);
  int covered = 0;
  for (int i = 0; i < 20'000; ++i) {
    // Middles of cells of the Earth's lattice.
    const double row = std::floor(std::uniform_real_distribution<>(499'100, 500'900)(random));
    const double column = std::floor(std::uniform_real_distribution<>(-10'900, -9'100)(random));
    const GeoPoint middle{(row + 0.5) * grid->step_lat_deg(),
                          (column + 0.5) * grid->step_lon_deg()};
    const bool is = grid->at(middle) == LandCover::scrub;
    EXPECT_EQ(is, inside(middle));
    covered += is;
  }
  EXPECT_GT(covered, 2000);
}

TEST(CoverGrid, NeighbouringWindowsHaveTheSameCells) {
  const std::vector<CoverArea> covers = {{LandCover::sand, {square(50.013, -1.0177, 0.0371)}}};
  const auto one = CoverGrid::of(window_of(covers, {50.02, -1.0}));
  const auto other = CoverGrid::of(window_of(covers, {50.05, -0.95}, 23'000.0));
  ASSERT_NE(one, nullptr);
  ASSERT_NE(other, nullptr);
  std::mt19937 random(4);
  for (int i = 0; i < 20'000; ++i) {
    const GeoPoint p{std::uniform_real_distribution<>(50.0, 50.06)(random),
                     std::uniform_real_distribution<>(-1.03, -0.97)(random)};
    EXPECT_EQ(one->at(p), other->at(p));
  }
}

TEST(CoverGrid, AWayOverItIsAsItsPlacesAre) {
  const auto grid =
      CoverGrid::of(window_of({{LandCover::sand, {square(50.0, 179.97, 0.05)}}}, {50.02, 179.99}));
  ASSERT_NE(grid, nullptr);
  for (const double east : {-1.1e-4, 1.3e-4}) {
    std::vector<LandCover> way(1000);
    const GeoPoint from{50.0, east > 0.0 ? 179.95 : 180.05};
    EXPECT_TRUE(grid->along(from, {1e-5, east}, way));
    for (std::size_t k = 0; k < way.size(); ++k) {
      const double n = static_cast<double>(k);
      EXPECT_EQ(way[k], grid->at({50.0 + 1e-5 * n, from.longitude_deg + east * n})) << k;
    }
  }
}

TEST(CoverGrid, StaysWithinItsBoundsForAnything) {
  const auto wide = CoverGrid::of(
      window_of({{LandCover::grass, {square(40.0, -10.0, 20.0)}}}, {50.0, -1.0}, 300'000.0));
  ASSERT_NE(wide, nullptr);
  EXPECT_LE(wide->rows() * wide->columns(), static_cast<std::int64_t>(CoverGrid::kMostCells));
  EXPECT_EQ(wide->at({50.0, -1.0}), LandCover::grass);
  std::printf("300 km: cells of %g deg, %lld x %lld\n", wide->step_lat_deg(),
              static_cast<long long>(wide->rows()), static_cast<long long>(wide->columns()));

  std::vector<GeoPoint> zigzag;
  for (int i = 0; i < 20'000; ++i) zigzag.push_back({i % 2 ? 50.1 : 49.9, -1.0 + 1e-5 * i});
  EXPECT_GT(crossings_of(zigzag), static_cast<double>(CoverGrid::kMostCrossings));
  const auto grid = CoverGrid::of(window_of({{LandCover::ice, {zigzag}},
                                             {LandCover::rock, {{{50.0, -1.0}}}},
                                             {LandCover::sand, {square(50.0, -1.0, 0.01)}}}));
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->at({50.005, -0.995}), LandCover::sand);

  std::vector<GeoPoint> polar;
  for (int i = 0; i < 36; ++i) polar.push_back({85.0, wrapped_longitude(10.0 * i)});
  for (const GeoPoint centre : {GeoPoint{90.0, 0.0}, GeoPoint{85.0, 180.0}, GeoPoint{-90.0, 5.0}}) {
    const auto over = CoverGrid::of(window_of({{LandCover::ice, {polar}}}, centre, 600'000.0));
    if (over) {
      EXPECT_LE(over->rows() * over->columns(), static_cast<std::int64_t>(CoverGrid::kMostCells));
    }
  }
}

}  // namespace
}  // namespace skerry::echo
