// SpokeResampler: a stream of spokes with other numbers of spokes and cells; peaks are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "protocol/video/spoke.hpp"

namespace skerry {

// Which cells of a row of `from` go into which of a row of `to`: where `to` has fewer, each of the
// source's into exactly one; where it has more, each of the target's shows one of the source's.
// Middles decide: 2 j + 1 of 2 from against 2 c + 1 of 2 to, in whole numbers, exact.
class CellShares {
 public:
  CellShares() = default;
  // Both 1 .. 65535.
  CellShares(std::uint32_t from, std::uint32_t to);

  std::uint32_t from() const { return from_; }
  std::uint32_t to() const { return to_; }
  // Cells [begin(c), end(c)) of the source are shown in cell c of the target; never empty.
  std::uint32_t begin(std::uint32_t c) const { return bounds_[c]; }
  std::uint32_t end(std::uint32_t c) const { return gathers_ ? bounds_[c + 1] : bounds_[c] + 1; }
  bool keeps() const { return from_ == to_; }
  // Whether no cell of the target shows more than two of the source.
  bool at_most_two() const { return from_ <= 2 * to_; }

 private:
  std::uint32_t from_ = 0, to_ = 0;
  bool gathers_ = false;
  std::vector<std::uint32_t> bounds_;
};

// One spoke of the resampled stream; valid during the call that gives it.
struct ResampledSpoke {
  // The header of the source's spoke that completed it, with index and geometry of the resampled
  // stream; bits as in the source.
  const SpokeHeader& header;
  std::span<const std::uint8_t> cells;
  std::span<const DopplerClass> doppler;  // empty if the source has none
};

// Where the target has fewer spokes or cells, every cell of the source goes into exactly one of the
// target, which shows the strongest of those it holds, with its Doppler class; where it has more,
// cells are repeated.  So no echo is lost, and none grows by more than one cell of the target.
//
// A spoke is given as soon as the last of its source's spokes has come.  After a gap in the source,
// or a change of its range or shape, what was held is given as it is and a new one begun; spokes of
// the target that no source spoke reached are left out.
// Held by SpokeResamplerTest.  Thread: one at a time.
class SpokeResampler {
 public:
  using Sink = std::function<void(const ResampledSpoke&)>;

  // 1 .. 8192 spokes a turn, 1 .. 8192 cells.
  SpokeResampler(std::uint32_t turn_spokes, std::uint32_t cells);

  // Requires header.geometry.cells cells, at least one, and an index within the turn.
  void add(const Spoke& spoke, const Sink& sink);

 private:
  std::uint32_t target_of(std::uint32_t index) const;
  bool goes_on(const SpokeHeader& next) const;
  void take_in(const Spoke& spoke);
  void put_cells_together();
  void give(std::uint32_t index, const Sink& sink);

  std::uint32_t turn_spokes_, cells_;
  CellShares shares_;
  SpokeHeader last_;                // of the source
  bool holding_ = false;            // held_ has video that was not given
  std::vector<std::uint8_t> held_;  // the source's cells
  std::vector<DopplerClass> held_doppler_;
  std::vector<std::uint8_t> given_;  // the target's
  std::vector<DopplerClass> given_doppler_;
};

}  // namespace skerry
