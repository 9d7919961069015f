// LocalThreshold: which cells of a row stand out from what is around them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/plotter/plots/cfar_multipliers.hpp"
#include "server/plotter/plots/row_kernels.hpp"
#include "server/plotter/plots/video_row.hpp"

namespace skerry::server {

// Cells [first, end) of a row, each above the threshold there.
struct Run {
  std::uint32_t first = 0, end = 0;
  friend bool operator==(const Run&, const Run&) = default;
};

// The video that displays have is logarithmic, cut off at both ends, by a gain and an STC that only
// the radar knows.  So the threshold is a level and not a ratio: a background, plus so many times
// its roughness, plus a least step.  In logarithmic video the multiplier of a CFAR is such a step,
// and a mean of levels is one of logarithms (a LOG/CFAR, Hansen and Ward 1972: a few tenths of a
// decibel worse than the CA-CFAR of powers, and harmed less by an echo beside).
//
// Ordered statistics over blocks instead of cells ("OS-CFAR", Rohling 1983, "Radar CFAR
// Thresholding in Clutter and Multiple Target Situations"): the row is cut into blocks of kBlock
// cells.  Each has a mean and a roughness, the mean deviation of its cells from it.  (Not the step
// from a cell to the next: where the receiver is sampled finer than its pulse, neighbours are alike
// and steps say a third of what the noise is.)  A block's background is the `rank`-th smallest mean
// among its neighbours within `around` blocks on either side, not counting itself and the next
// ones; its roughness is of the same rank.  So echoes may cover part of the neighbours, also those
// of land on one side.  Error against ordered statistics over cells: held by
// LocalThreshold.IsNearTheOneOverCells.
//
// The other statistics are of the same blocks: the mean of all of them, or the greater or the
// smaller one of the means of both sides, of means and of roughnesses alike.  Beyond the row's ends
// there is nothing: the neighbours are fewer there.
class LocalThreshold {
 public:
  static constexpr std::uint32_t kBlock = kBlockCells;
  static constexpr std::uint32_t kMostAround = kMostRanked / 2;
  static constexpr double kUpperRank = 0.8;

  struct Rule {
    Statistic statistic = Statistic::ordered;
    std::uint32_t around = 5;  // blocks on either side, 1 to kMostAround
    std::uint32_t guard = 1;   // blocks beside it that do not count, less than around
    double rank = 0.4;         // share of the neighbours that are smaller, of Statistic::ordered
    // Over the background, in mean deviations; one of Gaussian cells is 0.77 sigma.  Of noise alone
    // a million cells make 0.1 plots where a pulse is three cells, 0.9 where it is six (two rows
    // must agree, PlotExtractor::Rule::least_width), and at 4.0 three times as many; half a unit
    // more costs 1 dB of sensitivity.  Held from both sides by PlotDetection.
    double roughnesses = 4.25;
    // And so many times what the blocks around differ by (their mean of rank kUpperRank less that
    // of `rank`), of Statistic::ordered: cells of sea clutter are alike over a pulse, so a block's
    // own deviation does not show how far the next block may be.  0 to 20; counts beside
    // roughnesses, and with none of those not at all.
    double spreads = 3.0;
    std::uint8_t least_step = 24;        // over the background, levels
    std::uint8_t most_background = 110;  // levels; what is stronger all around is land, not clutter
  };
  // Errors: std::invalid_argument, says which value is out of its range.
  explicit LocalThreshold(const Rule& rule);
  LocalThreshold() : LocalThreshold(Rule{}) {}

  // Appends the runs to `out`, nearest first.  thresholds() is then of this row.
  void find(std::span<const std::uint8_t> levels, std::vector<Run>& out);
  // Of each block, the last one may be shorter: a cell is above it if it is more.  255: none is.
  std::span<const std::uint8_t> thresholds() const { return thresholds_; }
  std::span<const std::uint8_t> backgrounds() const { return backgrounds_; }

 private:
  // Of blocks, in 16ths of a level; kMostAround more at either end, for the kernels.
  struct Padded {
    std::vector<std::int16_t> values;
    std::int16_t* blocks() { return values.data() + kMostAround; }
  };

  void measure(std::span<const std::uint8_t> levels);
  void rank_all(Padded& of, double share, std::vector<std::int16_t>& into);
  void add_spread();
  void average_all(Padded& of, std::vector<std::int16_t>& into);
  void set_thresholds();

  Rule rule_;
  std::size_t blocks_ = 0;
  Padded means_, deviations_;
  std::vector<std::uint8_t> greatest_, over_;  // over_: blocks with cells above their threshold
  std::vector<std::int16_t> mean_around_, deviation_around_, upper_mean_;
  std::vector<std::uint32_t> sums_;  // of all blocks before
  std::vector<std::uint8_t> backgrounds_, thresholds_;
};

}  // namespace skerry::server
