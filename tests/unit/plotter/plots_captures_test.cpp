// What real radars saw, by plots: as many as there can be, the same again, and land where it is.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/unit/captures/imported.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

struct Capture {
  const char* file;
  double least_a_turn, most_a_turn;  // plots that are neither extended nor on land
};

struct Seen {
  std::vector<Plot> plots;
  PlotExtractor::Counts counts;
  double turns = 0.0;
};

Seen plots_of(const std::vector<Spoke>& spokes) {
  Seen seen;
  PlotExtractor extractor;
  for (const Spoke& spoke : spokes) {
    extractor.add(spoke, seen.plots);
    seen.turns += 1.0 / spoke.header.geometry.spokes_per_turn;
  }
  extractor.flush(seen.plots);
  seen.counts = extractor.counts();
  return seen;
}

class PlotsOfCaptures : public testing::TestWithParam<Capture> {};

TEST_P(PlotsOfCaptures, ArePlausibleAndTheSameAgain) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const captures::Imported got = captures::imported(unpack_radar_capture(GetParam().file));
  ASSERT_FALSE(got.spokes.empty());
  for (const auto& [radar, spokes] : got.spokes) {
    const Seen seen = plots_of(spokes), again = plots_of(spokes);
    double extended = 0, on_land = 0, in_clutter = 0, free = 0;
    for (const Plot& plot : seen.plots) {
      extended += plot.extended;
      on_land += !plot.extended && plot.on_land >= 0.5;
      in_clutter += !plot.extended && plot.clutter >= 0.5;
      free += !plot.extended && plot.on_land < 0.5;
    }
    const double turns = std::max(seen.turns, 1.0);
    std::printf(
        "%-36s radar %u: %5.1f turns, a turn: %6.1f plots, %5.1f extended, %5.1f on land, "
        "%5.1f free, %5.1f in clutter, %5.1f left out in it\n",
        GetParam().file, radar, seen.turns, static_cast<double>(seen.plots.size()) / turns,
        extended / turns, on_land / turns, free / turns, in_clutter / turns,
        static_cast<double>(seen.counts.in_clutter) / turns);
    EXPECT_GE(free / turns, GetParam().least_a_turn);
    EXPECT_LE(free / turns, GetParam().most_a_turn);
    EXPECT_EQ(seen.counts.runs_left_out, 0u);
    ASSERT_EQ(seen.plots.size(), again.plots.size());
    for (std::size_t i = 0; i < seen.plots.size(); ++i) {
      const Plot &a = seen.plots[i], &b = again.plots[i];
      ASSERT_TRUE(a.bearing == b.bearing && a.range_m == b.range_m && a.on_land == b.on_land &&
                  a.clutter == b.clutter && a.width_m == b.width_m && a.length_m == b.length_m)
          << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Recorded, PlotsOfCaptures,
    // By turns of spokes that came.  Of a turn or two, or with most spokes missing, the map learns
    // no land.
    testing::Values(Capture{"3g-trueheading.pcap.gz", 100, 180},
                    Capture{"4g-ranges-nm.pcap.gz", 50, 125},
                    Capture{"br24-ranges-nm.pcap.gz", 20, 60},
                    Capture{"furuno-drs4dnxt.pcap.gz", 1, 5},
                    Capture{"garminxhd_txon_txoff.pcap.gz", 100, 400},
                    Capture{"halo-velocitytrack-notarget.pcap.gz", 50, 150},
                    Capture{"halo20-ranges.pcap.gz", 10, 55},
                    Capture{"halo3-5-connect-transmit.pcap.gz", 100, 750},
                    Capture{"quantum2-solent-03-gain-sea-rain.pcap.gz", 10, 40},
                    Capture{"raymarine-e120-analog-tx-stdby.pcap.gz", 30, 85}),
    [](const testing::TestParamInfo<Capture>& each) { return test_name_of(each.param.file); });

}  // namespace
}  // namespace skerry::server
