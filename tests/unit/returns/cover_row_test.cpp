// Land by its charted cover: levels, objects and gaps, and that nothing else changes.
#include "echo/returns/cover_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "echo/returns/cover_echo.hpp"
#include "echo/returns/shore_returns.hpp"

namespace skerry::echo {
namespace {

constexpr GeoPoint kCoverShip{60.0, 5.0};
constexpr std::size_t kCoverCells = 600;

LandModel cover_model(double cell_m, double antenna_m = 20.0) {
  return {cell_m, antenna_m, 0.0015, 1e12, 9};
}

// `cover` over all land from `from_deg` north of the ship on.
std::shared_ptr<const CoverGrid> grid_of(LandCover cover, double from_deg = 0.0,
                                         double to_deg = 0.15) {
  CoastChart chart;
  chart.centre = kCoverShip;
  chart.radius_m = 20'000.0;
  chart.covers.push_back({cover,
                          {{{60.0 + from_deg, 4.8},
                            {60.0 + from_deg, 5.2},
                            {60.0 + to_deg, 5.2},
                            {60.0 + to_deg, 4.8}}}});
  return CoverGrid::of(chart);
}

// Rays a few degrees to either side of north, over land of that type from 2 to 5 km.
std::vector<float> north_power(const CoverGrid* grid, CoastType type, std::uint32_t bearing = 0,
                               double cell_m = 10.0, GroundProfile* profile = nullptr,
                               double antenna_m = 20.0) {
  const ShoreState state{{type, false, 0.0f}, 0.0, 0.0};
  const std::vector<ShoreStretch> land = {
      {2000.0, 5000.0, {state, 2000.0, false}, {state, 5000.0, false}}};
  std::vector<float> power(kCoverCells, 0.0f);
  const LandModel model = cover_model(cell_m, antenna_m);
  std::optional<ChartedCover> cover;
  if (grid) cover.emplace(ChartedCover{*grid, GroundTrack(kCoverShip, {}, bearing)});
  add_shores(land, model, {}, lattice_path(kCoverShip, {}, bearing, cell_m), nullptr, profile,
             power, cover ? &*cover : nullptr);
  return power;
}

TEST(CoverRow, LandWithoutCoverKeepsItsBits) {
  // Cover begins 3.5 km north: what lies before it is as without a grid.
  const auto beyond = grid_of(LandCover::built_up, 3500.0 / 111'412.0);
  const auto aside = grid_of(LandCover::built_up, 0.1, 0.11);
  for (const CoastType type : {CoastType::unknown, CoastType::artificial, CoastType::sandy}) {
    int changed = 0;  // where what lies so far inland is not all hidden
    for (std::uint32_t k = 0; k < 32; ++k) {
      const std::uint32_t bearing = k << 23;
      const auto bare = north_power(nullptr, type, bearing, 10.0, nullptr, 100.0);
      EXPECT_TRUE(north_power(aside.get(), type, bearing, 10.0, nullptr, 100.0) == bare);
      const auto power = north_power(beyond.get(), type, bearing, 10.0, nullptr, 100.0);
      EXPECT_TRUE(std::equal(power.begin(), power.begin() + 345, bare.begin()));
      changed += power != bare;
    }
    EXPECT_GT(changed, 8);
  }
}

TEST(CoverRow, ObjectsStandOnTheirShareOfTheGround) {
  for (const CoverEcho& echo : kCoverEchoes) {
    if (echo.objects_m == 0.0f) continue;
    const auto grid = grid_of(echo.cover);
    const double cell = std::min(5.0, static_cast<double>(echo.grain_m) / 4.0);
    LandModel model = cover_model(cell);
    double sum = 0.0;
    int count = 0;
    float most = 0.0f;
    for (std::uint32_t k = 0; k < 160; ++k) {
      const std::uint32_t bearing = k << 22;
      model.seed = k;
      const LatticePath path = lattice_path(kCoverShip, {}, bearing, cell);
      const ChartedCover charted{*grid, GroundTrack(kCoverShip, {}, bearing)};
      CoverRow row(charted, model, path, 1024);
      ASSERT_TRUE(row.read(0, 1024));
      for (std::size_t first = 32; first < 1024; first += kLandChunk) {
        float heights[kLandChunk];
        row.objects(first, heights);
        for (const float h : heights) {
          sum += static_cast<double>(h);
          most = std::max(most, h);
          ++count;
        }
        EXPECT_LE(most, static_cast<float>(row.most_objects(first, kLandChunk)));
      }
    }
    const double share = sum / count / static_cast<double>(echo.objects_m);
    std::printf("cover %d: share %.3f, stated %.2f\n", static_cast<int>(echo.cover), share,
                static_cast<double>(echo.share));
    EXPECT_NEAR(share, static_cast<double>(echo.share), 0.03);
    EXPECT_EQ(most, echo.objects_m);
  }
}

TEST(CoverRow, GrainFinerThanTwoCellsIsEven) {
  const auto grid = grid_of(LandCover::forest);
  const LandModel model = cover_model(40.0);
  const LatticePath path = lattice_path(kCoverShip, {}, 0, 40.0);
  const ChartedCover charted{*grid, GroundTrack(kCoverShip, {}, 0)};
  CoverRow row(charted, model, path, 128);
  ASSERT_TRUE(row.read(0, 128));
  float heights[kLandChunk];
  row.objects(64, heights);
  for (const float h : heights) EXPECT_FLOAT_EQ(h, 15.0f * 0.85f);
}

// Flat covers over the same relief: the same heights, so power is in proportion to gamma.
TEST(CoverRow, PowerIsInProportionToGamma) {
  const auto paved = grid_of(LandCover::paved), grass = grid_of(LandCover::grass);
  for (std::uint32_t k = 0; k < 16; ++k) {
    const auto low = north_power(paved.get(), CoastType::unknown, k << 20);
    const auto high = north_power(grass.get(), CoastType::unknown, k << 20);
    for (std::size_t i = 205; i < 495; ++i) {
      if (low[i] > 0.0f) {
        EXPECT_NEAR(high[i] / low[i], 3.16f, 0.001f);
      } else {
        EXPECT_EQ(high[i], 0.0f);
      }
    }
  }
}

// A cell of a flat beach's hinterland under forest against the radar equation: gamma times what the
// trees show over all before them.
TEST(CoverRow, AFirstRowOfTreesIsThatOfTheRadarEquation) {
  const auto grid = grid_of(LandCover::forest);
  double made = 0.0, expected = 0.0;
  for (std::uint32_t k = 0; k < 64; ++k) {
    const std::uint32_t bearing = k << 20;
    GroundProfile profile;
    profile.clear(kCoverCells);
    const auto power = north_power(grid.get(), CoastType::unknown, bearing, 10.0, &profile);
    const ChartedCover charted{*grid, GroundTrack(kCoverShip, {}, bearing)};
    const LatticePath path = lattice_path(kCoverShip, {}, bearing, 10.0);
    const LandModel model = cover_model(10.0);
    CoverRow row(charted, model, path, kCoverCells);
    row.read(0, kCoverCells);
    float trees[1];
    row.objects(200, trees);
    const double ground = static_cast<double>(profile.height_m[200]);
    made += static_cast<double>(power[200]);
    expected +=
        1e12 * 0.1 * 0.0015 * (ground + static_cast<double>(trees[0])) / std::pow(2005.0, 3);
  }
  EXPECT_NEAR(10.0 * std::log10(made / expected), 0.0, 1.0) << "the cover noise varies by place";
}

TEST(CoverRow, ApronsAndWetSandStayWhatTheyAre) {
  const auto grid = grid_of(LandCover::forest);
  const auto bare = north_power(nullptr, CoastType::artificial);
  const auto power = north_power(grid.get(), CoastType::artificial);
  for (std::size_t i = 200; i < 204; ++i) EXPECT_FLOAT_EQ(power[i], bare[i]);
  EXPECT_EQ(cover_share({{CoastType::artificial, false, 0.0f}, 0.0, 0.0}, 39.0), 0.0);
  EXPECT_EQ(cover_share({{CoastType::sandy, false, 0.0f}, 0.0, 0.0}, 0.0), 0.0);
  EXPECT_EQ(cover_share({{CoastType::sandy, false, 0.0f}, 0.0, 0.0}, 30.0), 1.0);
  EXPECT_EQ(cover_share({{CoastType::rocky, false, 0.0f}, 0.0, 0.0}, 0.0), 1.0);
}

// The first 240 m behind the apron of a quay, seen from 60 m: behind houses lie shadows.
TEST(CoverRow, HousesThrowShadowsIntoTheStreets) {
  const auto grid = grid_of(LandCover::built_up);
  const auto silent = [&](const CoverGrid* cover) {
    int cells = 0;
    for (std::uint32_t k = 0; k < 256; ++k) {
      const auto power = north_power(cover, CoastType::artificial, k << 23, 5.0, nullptr, 60.0);
      for (std::size_t i = 412; i < 460; ++i) cells += power[i] == 0.0f;
    }
    return cells / (256.0 * 48.0);
  };
  const double with = silent(grid.get()), without = silent(nullptr);
  std::printf("share in shadow: %.3f built up, %.3f without cover\n", with, without);
  EXPECT_GT(with, without + 0.1);
}

}  // namespace
}  // namespace skerry::echo
