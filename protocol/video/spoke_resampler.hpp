// SpokeResampler: a stream of spokes with other numbers of spokes and cells; peaks are kept.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "protocol/video/spoke.hpp"

namespace skerry {

// One spoke of the resampled stream; valid during the call that gives it.
struct ResampledSpoke {
  const SpokeHeader& header;  // of the source's spoke that completed it, but for index and geometry
  std::uint32_t turn_spokes;  // of the resampled stream
  std::span<const std::uint8_t> cells;
  std::span<const DopplerClass> doppler;  // empty if the source has none
};

// Where the target has fewer spokes or cells, every cell of the source goes into exactly one of the
// target, which shows the strongest of those it holds; where it has more, cells are repeated.  So
// no echo is lost, and none grows by more than one cell of the target.  A spoke is given when the
// antenna has passed it; after a gap in the source (or a change of range) it begins anew, and
// spokes of the target that no source spoke reached are left out. Thread: one at a time.
class SpokeResampler {
 public:
  // 1 .. 8192 spokes a turn, 1 .. 8192 cells.
  SpokeResampler(std::uint32_t turn_spokes, std::uint32_t cells);

  void add(const Spoke& spoke, const std::function<void(const ResampledSpoke&)>& sink);

 private:
  void give(const std::function<void(const ResampledSpoke&)>& sink);

  std::uint32_t turn_spokes_, cells_;
  SpokeHeader header_;
  std::uint64_t source_next_ = 0;  // sequence expected
  std::uint32_t open_index_ = 0;   // of the target's spoke in the making
  bool open_ = false;
  std::vector<std::uint8_t> held_;
  std::vector<DopplerClass> held_doppler_;
};

}  // namespace skerry
