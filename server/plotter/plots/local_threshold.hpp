// LocalThreshold: which cells of a row stand out from what is around them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/plotter/plots/video_row.hpp"

namespace skerry::server {

// Cells [first, end) of a row, each above the threshold there.
struct Run {
  std::uint32_t first = 0, end = 0;
  friend bool operator==(const Run&, const Run&) = default;
};

// The video that displays have is logarithmic, cut off at both ends, by a gain and an STC that only
// the radar knows.  So the threshold is a level and not a ratio: a background, plus so many times
// its roughness, plus a least step.
//
// Ordered statistics over blocks instead of cells ("OS-CFAR", Rohling 1983, "Radar CFAR
// Thresholding in Clutter and Multiple Target Situations"): the row is cut into blocks of kBlock
// cells.  Each has a mean and a roughness, the mean step from a cell to the next.  A block's
// background is the `rank`-th smallest mean among its neighbours within `around` blocks on either
// side, not counting itself and the next ones; its roughness is of the same rank.  So echoes may
// cover part of the neighbours, also those of land on one side.  Error against ordered statistics
// over cells: held by LocalThreshold.IsNearTheOneOverCells.
class LocalThreshold {
 public:
  static constexpr std::uint32_t kBlock = 16;
  static constexpr std::uint32_t kMostAround = 8;

  struct Rule {
    std::uint32_t around = 5;  // blocks on either side, 1 to kMostAround
    std::uint32_t guard = 1;   // blocks beside it that do not count, less than around
    double rank = 0.4;         // share of the neighbours that are smaller
    double roughnesses = 5.0;  // over the background, in mean steps; of Gaussian cells 1.13 sigma
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
  void measure(std::span<const std::uint8_t> levels);
  void set_thresholds();

  Rule rule_;
  std::vector<std::uint16_t> means_, steps_;  // of blocks, in 16ths of a level
  std::vector<std::uint8_t> backgrounds_, thresholds_;
};

}  // namespace skerry::server
