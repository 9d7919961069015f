// Rows of cells of one size into rows of cells of another: twice as fine, half as fine, or any.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::echo {

// Cells half as long by straight lines between the middles of cells:
// out[2k] = (in[k-1] + 3 in[k]) / 4, out[2k+1] = (3 in[k] + in[k+1]) / 4; before the first and
// behind the last cell lies another like it.  Requires out.size() == 2 * in.size(), no overlap.
// Error: 2e-7 relative.
void double_cells(std::span<const float> in, std::span<float> out) noexcept;

// Cells twice as long: the larger of two, or their mean.  Requires in.size() >= 2 * out.size().
// Exact, but for the rounding of a mean.
void halve_cells_by_peak(std::span<const float> in, std::span<float> out) noexcept;
void halve_cells_by_mean(std::span<const float> in, std::span<float> out) noexcept;

// Any finer cells by straight lines: out[i] = in[at[i]] + share[i] * (in[at[i] + 1] - in[at[i]]).
// Requires at[i] + 1 < in.size(), share in [0, 1], at.size() == share.size() == out.size().
void interpolate_cells(std::span<const float> in, std::span<const std::uint32_t> at,
                       std::span<const float> share, std::span<float> out) noexcept;

// Cells up to twice as long, whole cells or not: the largest of those that one holds any part of.
// out[i] = max(in[at[i]], in[at[i] + 1], in[last[i]]).  Requires at[i] + 1 and last[i] <
// in.size(), at.size() == last.size() == out.size().  Exact.
void peak_cells(std::span<const float> in, std::span<const std::uint32_t> at,
                std::span<const std::uint32_t> last, std::span<float> out) noexcept;

}  // namespace skerry::echo
