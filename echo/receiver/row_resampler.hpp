// RowResampler: a radar's row of cells as a view on another range scale sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/receiver/controls.hpp"

namespace skerry::echo {

// Cells shorter than the radar's are parts of them: power between the middles of cells follows
// straight lines, which keeps peaks as they are.  A longer one holds several of the radar's, and
// shows their peak or mean; cells the radar's row does not reach are empty.
// Immutable; any thread.
class RowResampler {
 public:
  // `ratio`: length of a view cell in the radar's cells, 1/256 to 1024.
  RowResampler(std::uint32_t row_cells, std::uint32_t view_cells, double ratio,
               Decimation decimation);

  // View cells are the radar's first ones.
  bool keeps() const { return way_ == Way::keep; }
  // View cells that lie wholly within the radar's row.
  std::uint32_t reach() const { return reach_; }
  // The radar's cells [begin, end) that a view cell below reach() is made of.
  struct Held {
    std::size_t begin, end;
  };
  Held held_by(std::uint32_t view_cell) const;
  // Requires in.size() == row_cells, out.size() == view_cells, no overlap.
  void resample(std::span<const float> in, std::span<float> out) const;

 private:
  enum class Way : std::uint8_t { keep, double_up, interpolate, halve, pick_peaks, gather };

  void gather(std::span<const float> in, std::span<float> out) const;

  Way way_ = Way::keep;
  Decimation decimation_;
  std::uint32_t row_cells_;
  double ratio_;
  unsigned octaves_ = 0;  // |log2(ratio)|, where that is whole
  std::uint32_t reach_;
  std::vector<std::uint32_t> at_, last_;
  std::vector<float> share_;
};

}  // namespace skerry::echo
