// Spokes that no radar sends: the extractor goes on, within its bounds.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <limits>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

void expect_sound(const std::vector<Plot>& plots) {
  for (const Plot& plot : plots) {
    ASSERT_TRUE(std::isfinite(plot.range_m) && plot.range_m > 0.0 && plot.range_m <= 1e6);
    ASSERT_TRUE(std::isfinite(plot.bearing_sigma_rad) && plot.bearing_sigma_rad > 0.0);
    ASSERT_TRUE(std::isfinite(plot.range_sigma_m) && plot.range_sigma_m > 0.0);
    ASSERT_TRUE(plot.length_m >= 0.0 && plot.width_m >= 0.0);
    ASSERT_TRUE(plot.on_land >= 0.0 && plot.on_land <= 1.0);
    ASSERT_TRUE(plot.clutter >= 0.0 && plot.clutter <= 1.0);
    ASSERT_GT(plot.cells, 0u);
  }
}

TEST(HostileSpokes, AnotherGeometryRangeAndPlaceEverySpoke) {
  PlotExtractor extractor;
  std::uint64_t state = 9;
  const auto draw = [&](std::uint64_t below) {
    (void)next_draw(state);
    return (state >> 20) % below;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double ranges[] = {0.0, nan, HUGE_VAL, -5.0, 1e-9, 1.0, 100.0, 5556.0, 1e6, 1e18};
  const double places[] = {0.0, 60.0, -90.0, 90.0, nan, HUGE_VAL, 179.9999, -180.0, 1e308};
  std::vector<Plot> plots;
  for (int i = 0; i < 20000; ++i) {
    Spoke spoke;
    SpokeHeader& header = spoke.header;
    // Mostly a geometry that holds for some spokes, so that echoes grow.
    const std::uint64_t kind = draw(40) == 0 ? draw(5) : 5;
    header.geometry = kind == 0   ? ScanGeometry{128, 128, 8}
                      : kind == 1 ? ScanGeometry{8192, 4096, 4}
                      : kind == 2 ? ScanGeometry{0, 0, 0}
                      : kind == 3 ? ScanGeometry{250, 252, 8}
                      : kind == 4 ? ScanGeometry{2048, 0xffffffff, 8}
                                  : ScanGeometry{2048, 1024, 8};
    header.scan = draw(100) == 0 ? static_cast<std::uint32_t>(state) : 7;
    header.index = draw(50) == 0 ? static_cast<std::uint32_t>(draw(10000))
                                 : static_cast<std::uint32_t>(i) % 2048;
    header.instrumented_range = metres(draw(20) == 0 ? ranges[draw(10)] : 5000.0);
    header.heading = TrueBearing::from_units(static_cast<std::uint32_t>(state));
    header.own_ship = {places[draw(9)], places[draw(9)]};
    const std::uint64_t cells = draw(30) == 0 ? draw(3000) : header.geometry.cells;
    if (cells <= 4096) spoke.cells.resize(cells);
    const std::uint64_t pattern = draw(4);
    for (std::size_t k = 0; k < spoke.cells.size(); ++k)
      spoke.cells[k] = pattern == 0   ? 255
                       : pattern == 1 ? static_cast<std::uint8_t>(k % 2 * 255)
                       : pattern == 2 ? static_cast<std::uint8_t>(128.0 + 36.0 * next_draw(state))
                                      : 0;
    plots.clear();
    extractor.add(spoke, plots);
    expect_sound(plots);
    ASSERT_LE(plots.size(), 8 * BlobBuilder::kMostOpen);
  }
  plots.clear();
  extractor.flush(plots);
  expect_sound(plots);
  EXPECT_GT(extractor.counts().spokes_left_out, 0u);
  EXPECT_GT(extractor.counts().rows, 1000u);
}

// The worst for memory: all of a turn bright, or a chequered board of it; the second turn takes
// none that the first did not.
TEST(HostileSpokes, HoldNoMoreMemoryTurnByTurn) {
  for (const int pattern : {0, 1, 2}) {
    PlotExtractor extractor;
    std::vector<Plot> plots;
    plots.reserve(200000);
    std::size_t after_two = 0;
    for (std::uint64_t n = 0; n < 2048 * 4; ++n) {
      MadeRadar radar;
      radar.geometry = {2048, 512, 8};
      radar.noise_mean = 0.0;
      Spoke spoke = radar.spoke(n);
      for (std::size_t k = 0; k < spoke.cells.size(); ++k) {
        const bool lit = pattern == 0 || (pattern == 1 ? (k / 2 + n / 4) % 2 == 0 : k % 3 == 0);
        spoke.cells[k] = lit ? 255 : 0;
      }
      plots.clear();
      extractor.add(spoke, plots);
      if (n == 2048 * 2) after_two = mallinfo2().uordblks;
    }
    // A sanitizer's heap tells nothing: 0 both times.
    EXPECT_LE(mallinfo2().uordblks, after_two + (2u << 20)) << pattern;
  }
}

// Turns that jump: on, back, and by the whole of 32 bits.
TEST(HostileSpokes, TurnsThatJumpBeginAnew) {
  MadeRadar radar;
  radar.echoes = {{90.0, 3000.0, 220.0}};
  PlotExtractor extractor;
  std::vector<Plot> plots;
  int turns = 0;
  for (const std::uint32_t scan : {0u, 1u, 5000u, 4999u, 3u, 0xffffffffu, 0u, 1u, 0x80000000u}) {
    for (std::uint64_t n = 0; n < 2048; ++n) {
      Spoke spoke = radar.spoke(n);
      spoke.header.scan = scan;
      extractor.add(spoke, plots);
    }
    ++turns;
  }
  extractor.flush(plots);
  EXPECT_GE(plots.size(), static_cast<std::size_t>(turns) - 1);
  EXPECT_LE(plots.size(), static_cast<std::size_t>(turns));
}

}  // namespace
}  // namespace skerry::server
