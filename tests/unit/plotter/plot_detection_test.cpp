// Detection against false alarms: both sides of the threshold.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/unit/plotter/pulsed_spokes.hpp"

namespace skerry::server {
namespace {

struct Seen {
  double detection = 0.0;          // share of points with a plot on them
  double false_per_million = 0.0;  // plots elsewhere, a million cells of the radar
};

Seen look(const PulsedRadar& radar, std::uint64_t turns, const PlotExtractor::Rule& rule = {}) {
  PlotExtractor extractor(rule);
  std::vector<Plot> plots;
  const std::uint64_t spokes = turns * radar.geometry.spokes_per_turn;
  for (std::uint64_t n = 0; n < spokes; ++n) extractor.add(radar.spoke(n), plots);
  extractor.flush(plots);
  std::size_t hits = 0, others = 0;
  for (const Plot& plot : plots) {
    const double place = plot.bearing.in_degrees() / radar.apart_deg;
    const double off_deg = (place - std::floor(place) - 0.5) * radar.apart_deg;
    const bool on =
        std::fabs(off_deg) < radar.beam_deg && std::fabs(plot.range_m - radar.range_m) < 25.0;
    (on ? hits : others) += 1;
  }
  Seen seen;
  seen.detection =
      static_cast<double>(hits) / (static_cast<double>(turns) * 360.0 / radar.apart_deg);
  seen.false_per_million =
      1e6 * static_cast<double>(others) / static_cast<double>(spokes * radar.geometry.cells);
  return seen;
}

// Noise alike in range by whole pulses is the hardest: one draw is several cells at once.  At most
// half a plot in a turn of two million cells where a pulse is three of them, and two where it is
// six.
TEST(PlotDetection, NoiseAloneMakesFewPlotsATurn) {
  for (const auto& [pulse, most] : {std::pair{1u, 0.1}, std::pair{3u, 0.25}, std::pair{6u, 1.0}}) {
    PulsedRadar radar;
    radar.pulse_cells = pulse;
    const Seen seen = look(radar, 20);
    std::printf("pulse of %u cells: %.3f false plots a million cells\n", pulse,
                seen.false_per_million);
    EXPECT_LE(seen.false_per_million, most) << pulse;
  }
}

// A point that does not fade, and one that does from turn to turn (Swerling 1), by the
// signal-to-noise ratio of one pulse.  About six pulses are within the beam: the best that can be
// made of them, for one false alarm in 10^6 cells and 90 %, is 6.6 dB (Albersheim 1981) and 1.6 dB
// for the beam's shape.  What is asked here of a steady point is at most 3.3 dB more.
TEST(PlotDetection, AWeakPointIsSeenByItsStrength) {
  struct Row {
    double snr_db, steady, fading;  // least shares
  };
  double last = 0.0;
  for (const Row row : {Row{2.0, 0.0, 0.0}, Row{5.0, 0.0, 0.05}, Row{8.0, 0.15, 0.2},
                        Row{11.5, 0.9, 0.45}, Row{15.0, 0.98, 0.7}, Row{18.5, 0.98, 0.85}}) {
    PulsedRadar radar;
    radar.snr_db = row.snr_db;
    const double steady = look(radar, 5).detection;
    radar.fades = true;
    const double fading = look(radar, 5).detection;
    std::printf("%4.1f dB: steady %.2f, fading %.2f\n", row.snr_db, steady, fading);
    EXPECT_GE(steady, row.steady) << row.snr_db;
    EXPECT_GE(fading, row.fading) << row.snr_db;
    EXPECT_GE(steady + 0.05, last) << row.snr_db << ": more strength, more seen";
    // Not by a lower threshold: what is as weak as noise is not seen.
    if (row.snr_db <= 2.0) {
      EXPECT_LE(steady, 0.1);
    }
    last = steady;
  }
}

}  // namespace
}  // namespace skerry::server
