// RowResampler: a radar's row of cells as a view on another range scale sees it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/receiver/controls.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::echo {

// A view has as many cells as its radar.  On a shorter scale its cells are parts of the radar's:
// power between the middles of cells follows straight lines, which keeps peaks as they are.  On a
// longer one a cell holds several of the radar's, and shows their peak or mean; cells the radar
// does not reach are empty.
// Immutable; any thread.
class RowResampler {
 public:
  RowResampler(std::uint32_t cells, RangeScale radar, RangeScale view, Decimation decimation);

  bool keeps() const { return way_ == Way::keep; }  // the scales are the same
  // View cells that lie wholly within the radar's range.
  std::uint32_t reach() const { return reach_; }
  // Requires in.size() == out.size() == cells, no overlap.
  void resample(std::span<const float> in, std::span<float> out) const;

 private:
  enum class Way : std::uint8_t { keep, double_up, interpolate, halve, gather };

  void gather(std::span<const float> in, std::span<float> out) const;

  Way way_ = Way::keep;
  Decimation decimation_;
  double ratio_;          // length of a view cell in the radar's cells
  unsigned octaves_ = 0;  // |log2(ratio)|, where that is whole
  std::uint32_t reach_;
  std::vector<std::uint32_t> at_;
  std::vector<float> share_;
};

}  // namespace skerry::echo
