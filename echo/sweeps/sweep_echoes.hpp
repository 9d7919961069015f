// SweepEchoes: the echo of a radar round the turn, from which a board's sweeps are cut.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "echo/radar/radar_set.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// Rows of instantaneous echo power over the receiver's mean noise, at grid azimuths finer than the
// beam.  A board asks for the rows on both sides of where its antenna points.
// Thread: one at a time.
class SweepEchoes {
 public:
  struct Wish {
    double reach_m = 10'000.0;     // of the last sample
    std::uint32_t pulse_code = 0;  // 0: what the radar has on the air; n: the set's n-th
    double rpm = 24.0;
    double tick_m = 0.0;  // range of a tick of the sample clock; 0: not known
    friend bool operator==(const Wish&, const Wish&) = default;
  };
  struct Grid {
    std::uint32_t rows_per_turn = 4096;
    std::uint32_t cells = 4096;
    double cell_m = 1.0;
    Pulse pulse;  // in use
    double video_range_db = kLogVideoDb;
    double blind_m = 0.0;    // nothing is seen nearer
    std::uint64_t seed = 0;  // of the scenario
    std::uint32_t radar = 0;
  };

  virtual ~SweepEchoes() = default;

  // Another wish may take tens of milliseconds at the next row.
  virtual void set(const Wish& wish) = 0;
  virtual Grid grid() const = 0;
  // Whether the radar transmits; without, rows are empty and only noise is seen.
  virtual bool radiates() const = 0;

  // Row n, counted from the antenna's start (turn n / rows_per_turn, index 0 over the bow), as it
  // is at `when`.  n may not go back by more than 16.  Valid until the call after the next: two
  // rows are held at a time.  grid().cells values >= 0.
  virtual std::span<const float> row(std::uint64_t n, ScenarioTime when) = 0;
};

// The shortest cells of whole ticks that reach as far as is wished; without a tick, cells that just
// do.  Where a cell is one tick its middle is a sample's, and the receiver has nothing to
// interpolate in range.  Elsewhere straight lines between cells of length d take
// (1 - exp(-2 (d / l)^2)) / 3 off the variance of the power of sea and rain, l = 0.632 pulses
// (speckle.hpp): 21 % at d = 5.4 m for 0.08 us, 3 % for 0.25 us; held by
// SweepSpokes.BetweenCellsHaveAsMuchLessSpeckleAsTheCellsAreLong.
inline double sweep_cell_m(const SweepEchoes::Wish& wish, std::uint32_t cells) {
  if (!(wish.tick_m > 0.0)) return wish.reach_m / cells;
  return wish.tick_m * std::max(1.0, std::ceil(wish.reach_m / (wish.tick_m * cells) - 1e-9));
}

}  // namespace skerry::echo
