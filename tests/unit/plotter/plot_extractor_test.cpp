// Echoes of known places, and what the extractor says of them.
#include "server/plotter/plots/plot_extractor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

std::vector<Plot> plots_of(const MadeRadar& radar, std::uint64_t from, std::uint64_t to,
                           const PlotExtractor::Rule& rule = {}) {
  PlotExtractor extractor(rule);
  std::vector<Plot> plots;
  for (std::uint64_t n = from; n < to; ++n) extractor.add(radar.spoke(n), plots);
  extractor.flush(plots);
  return plots;
}

double off_deg(const Plot& plot, double bearing_deg) {
  return std::fabs(std::remainder(plot.bearing.in_degrees() - bearing_deg, 360.0));
}

TEST(PlotExtractor, FindsAnEchoWhereItIsOnEveryGeometry) {
  for (const ScanGeometry& geometry :
       {ScanGeometry{2048, 1024, 8}, ScanGeometry{4096, 1024, 8}, ScanGeometry{360, 512, 8},
        ScanGeometry{1440, 705, 8}, ScanGeometry{2048, 1024, 4}, ScanGeometry{250, 252, 8}}) {
    for (const double range_nm : {0.75, 3.0, 12.0}) {
      MadeRadar radar;
      radar.geometry = geometry;
      radar.range_nm = range_nm;
      const double range_m = 0.6 * range_nm * 1852.0;
      radar.pulse_m = std::max(20.0, 2.0 * range_nm * 1852.0 / geometry.cells);
      radar.beam_deg = std::max(1.2, 3.0 * 360.0 / geometry.spokes_per_turn);
      for (const double bearing_deg : {0.0, 47.3, 180.0, 359.9}) {
        radar.echoes = {{bearing_deg, range_m, 220.0}};
        const std::uint64_t turn = geometry.spokes_per_turn;
        PlotExtractor::Rule rule;
        rule.beam_deg = radar.beam_deg;
        rule.pulse_m = radar.pulse_m;
        const auto plots = plots_of(radar, turn / 4, 2 * turn + turn / 4, rule);
        ASSERT_GE(plots.size(), 2u) << geometry.spokes_per_turn << " spokes, " << range_nm;
        ASSERT_LE(plots.size(), 2u);
        for (const Plot& plot : plots) {
          EXPECT_LE(off_deg(plot, bearing_deg), 0.15 + 0.25 * 360.0 / geometry.spokes_per_turn);
          EXPECT_NEAR(plot.range_m, range_m, 2.0 * range_nm * 1852.0 / geometry.cells + 7.5);
          EXPECT_FALSE(plot.extended);
        }
      }
    }
  }
}

TEST(PlotExtractor, SeesAnEchoOnceATurnAlsoAcrossTheBowAndNorth) {
  MadeRadar radar;
  radar.heading_deg = 100.0;
  radar.echoes = {{100.0, 3000.0, 220.0}, {0.0, 2000.0, 220.0}, {200.0, 1000.0, 220.0}};
  const std::uint64_t turn = radar.geometry.spokes_per_turn;
  // From abeam on, so that nothing is cut at the beginning.
  const auto plots = plots_of(radar, turn / 6, 4 * turn + turn / 6);
  EXPECT_EQ(plots.size(), 12u);
  for (const Plot& plot : plots) {
    EXPECT_LT(std::min({off_deg(plot, 100.0), off_deg(plot, 0.0), off_deg(plot, 200.0)}), 0.1);
    EXPECT_EQ(plot.width_m, 0.0) << "the beam is deducted";
  }
}

TEST(PlotExtractor, BearingsAreTrueWhileTheShipTurns) {
  MadeRadar radar;
  radar.turn_deg_s = 3.0;
  radar.echoes = {{90.0, 3000.0, 220.0}};
  const std::uint64_t turn = radar.geometry.spokes_per_turn;
  const auto plots = plots_of(radar, 0, 6 * turn);
  ASSERT_GE(plots.size(), 5u);
  for (const Plot& plot : plots) EXPECT_LT(off_deg(plot, 90.0), 0.1);
}

TEST(PlotExtractor, NoiseAloneMakesFewPlots) {
  MadeRadar radar;
  const std::uint64_t turn = radar.geometry.spokes_per_turn;
  EXPECT_LE(plots_of(radar, 0, 4 * turn).size(), 2u);
  radar.noise_mean = 60.0;
  radar.noise_sigma = 15.0;  // the gain turned up
  EXPECT_LE(plots_of(radar, 0, 4 * turn).size(), 2u);
}

TEST(PlotExtractor, TellsShipsApartThatAreABeamOrAPulseApart) {
  MadeRadar radar;
  radar.echoes = {{90.0, 3000.0, 150.0}, {92.2, 3000.0, 150.0}};
  const std::uint64_t turn = radar.geometry.spokes_per_turn;
  EXPECT_EQ(plots_of(radar, 0, turn).size(), 2u);
  radar.echoes = {{90.0, 3000.0, 150.0}, {90.0, 3080.0, 150.0}};
  EXPECT_EQ(plots_of(radar, 0, turn).size(), 2u);
}

// They may as well be halves of one hull, whose middle is half way between them.
TEST(PlotExtractor, TheRangeOfAPartIsAsUnsureAsItsMiddleIsOffTheWhole) {
  MadeRadar radar;
  const std::uint64_t turn = radar.geometry.spokes_per_turn;
  // With a weaker bridge.
  radar.echoes = {{90.0, 3000.0, 150.0}, {90.0, 3080.0, 150.0}, {90.0, 3050.0, 90.0, 60.0}};
  const auto parts = plots_of(radar, 0, turn);
  ASSERT_EQ(parts.size(), 2u);
  radar.echoes = {{90.0, 3000.0, 150.0}, {110.0, 3080.0, 150.0}};
  const auto apart = plots_of(radar, 0, turn);
  ASSERT_EQ(apart.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(parts[i].range_sigma_m, 15.0);
    EXPECT_LT(apart[i].range_sigma_m, 10.0) << "of two that do not touch";
    EXPECT_NEAR(parts[i].bearing_sigma_rad, apart[i].bearing_sigma_rad, 0.002);
  }
}

TEST(PlotExtractor, ALongCoastIsExtendedAndAShipIsNot) {
  MadeRadar radar;
  radar.echoes = {{90.0, 3000.0, 220.0, 600.0, 2500.0}, {200.0, 2000.0, 220.0, 300.0, 40.0}};
  const auto plots = plots_of(radar, 0, radar.geometry.spokes_per_turn);
  bool ship = false;
  for (const Plot& plot : plots) {
    if (off_deg(plot, 200.0) < 1.0) {
      ship = true;
      EXPECT_FALSE(plot.extended);
      EXPECT_NEAR(plot.length_m, 300.0, 20.0);
    } else {
      EXPECT_TRUE(plot.extended) << plot.bearing.in_degrees() << " " << plot.range_m;
    }
  }
  EXPECT_TRUE(ship);
}

TEST(PlotExtractor, TheSamePlotsHoweverSpokesAreLostElsewhere) {
  MadeRadar radar;
  radar.echoes = {{90.0, 3000.0, 220.0}};
  PlotExtractor extractor;
  std::vector<Plot> plots;
  for (std::uint64_t n = 0; n < 2048; ++n) {
    if (n % 7 == 3 || (n > 1000 && n < 1300)) continue;
    extractor.add(radar.spoke(n), plots);
    if (n % 5 == 0) extractor.add(radar.spoke(n), plots);       // twice
    if (n % 11 == 4) extractor.add(radar.spoke(n - 3), plots);  // late
  }
  extractor.flush(plots);
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_LT(off_deg(plots[0], 90.0), 0.15);
  EXPECT_GT(extractor.counts().spokes_left_out, 0u);
}

TEST(PlotExtractor, TheSameBitsOnEveryInstructionSet) {
  MadeRadar radar;
  radar.range_nm = 0.75;
  radar.noise_mean = 40.0;
  radar.noise_sigma = 15.0;
  radar.turn_deg_s = 1.0;
  radar.echoes = {{90.0, 700.0, 220.0, 100.0, 300.0}, {10.0, 500.0, 110.0}, {300.0, 900.0, 90.0}};
  PlotExtractor::Rule rule;
  rule.threshold.roughnesses = 2.5;  // noise too
  rule.threshold.least_step = 4;
  std::vector<std::vector<Plot>> all;
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    echo::force_isa(isa);
    all.push_back(plots_of(radar, 0, 4 * 2048, rule));
  }
  echo::force_isa(echo::best_isa());
  ASSERT_GT(all[0].size(), 20u);
  for (const auto& plots : all) {
    ASSERT_EQ(plots.size(), all[0].size());
    for (std::size_t i = 0; i < plots.size(); ++i) {
      const Plot &a = plots[i], &b = all[0][i];
      ASSERT_TRUE(a.bearing == b.bearing && a.range_m == b.range_m && a.length_m == b.length_m &&
                  a.width_m == b.width_m && a.bearing_sigma_rad == b.bearing_sigma_rad &&
                  a.range_sigma_m == b.range_sigma_m && a.on_land == b.on_land &&
                  a.clutter == b.clutter && a.greatest == b.greatest && a.cells == b.cells);
    }
  }
}

TEST(PlotExtractor, RefusesRulesOutOfTheirRange) {
  PlotExtractor::Rule rule;
  rule.beam_deg = 0.0;
  EXPECT_THROW(PlotExtractor{rule}, std::invalid_argument);
  rule = {};
  rule.threshold.around = 9;
  EXPECT_THROW(PlotExtractor{rule}, std::invalid_argument);
}

}  // namespace
}  // namespace skerry::server
