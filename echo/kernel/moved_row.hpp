// Rows of mean power, packed in half the space and laid at another range, with or without speckle.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace skerry::echo {

// The upper half of a float: its sign, exponent and seven bits of its mantissa.
using PackedPower = std::uint16_t;

// Cells whose greatest power pack_power() tells as one.
inline constexpr std::size_t kPackBlock = 16;

// packed[i] = power[i], rounded to nearest; 0 where power[i] < `least`.  peaks[b] is the greatest
// power[i] of block b, the last one of what is left; peaks.size() == blocks.
// Error: 2^-8 relative, 0.017 dB.  Held by MovedRow.PacksWithinItsBound.
// Requires power >= 0, finite, below 1e38, and least > 0.
void pack_power(std::span<const float> power, float least, std::span<PackedPower> packed,
                std::span<float> peaks) noexcept;

// How a stretch of a row stands in another row.
struct RowShift {
  float near_weight = 1.0f;  // of row[i]
  float far_weight = 0.0f;   // of row[i + 1]
  float gain = 1.0f;         // of cell 0
  float gain_step = 0.0f;    // more for each cell
};

// A stretch of a row, and the cells of another that it is added to.
struct MovedRun {
  const PackedPower* row = nullptr;
  RowShift shift;
  std::uint32_t first = 0, count = 0;  // cells of the other
};

// One value packed, as pack_power() does where it is not too little.
inline PackedPower packed_value(float x) {
  return static_cast<PackedPower>((std::bit_cast<std::uint32_t>(x) + 0x8000u) >> 16);
}
inline __attribute__((always_inline)) float unpacked_value(PackedPower x) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(x) << 16);
}

// Rows are read up to so many cells beyond the last that counts.
inline constexpr std::size_t kRowPadding = 16;

// power[first + i] += (near_weight row[i] + far_weight row[i + 1]) (gain + gain_step i) of each
// run, for i < its count.  Reads count + kRowPadding cells of each row.  Requires first + count <=
// power.size(); the cells behind a run stay as they are, but they are written: no two threads on
// one row.  Error: four float roundings.  Held by MovedRow.IsAddedAsItsReferenceHasIt.
void add_moved(std::span<const MovedRun> runs, std::span<float> power) noexcept;

// Where runs are laid, and by what they fluctuate.
struct SpeckledRow {
  std::span<const PackedPower> speckle;
  std::span<float> power;
};

// Sets power[c] of all cells: to the same times 1 - share + share speckle[c] where a run lies, and
// to 0 elsewhere; the second form that of two rows, of the same length, at once.  Requires runs
// that lie apart, nearest first; speckle holds what the last one needs, and both it and `power`
// have kRowPadding cells more, which those of `power` do not keep.
// Error: six float roundings.  Held by MovedRow.IsLaidAsItsReferenceHasIt.
void lay_moved(std::span<const MovedRun> runs, float share, const SpeckledRow& row) noexcept;
void lay_moved(std::span<const MovedRun> runs, float share, const SpeckledRow& a,
               const SpeckledRow& b) noexcept;

// Twins in double; without speckle where there is none.
double unpacked_reference(PackedPower packed);
void add_moved_reference(std::span<const MovedRun> runs, std::span<const float> speckle,
                         float share, std::span<double> power);

}  // namespace skerry::echo
