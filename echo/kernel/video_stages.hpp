// Receiver stages on finished 8-bit video: differentiation (FTC), stretching and smoothing of
// echoes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace skerry::echo {

// These work on whole spokes of `cells` cells, one after the other in `video`; a few at a time are
// faster than one.  `scratch` is resized as needed and may be reused.

// Rain control.  A cell loses weight / 256 of the mean of the 2^octaves cells of its spoke before
// it (cells before the first are 0); what would be negative is 0.  weight <= 256, octaves <= 11.
// The mean is made by halving sums in 8 bits, rounded up and down in turn.
// Error: (octaves + 1) / 2 video steps, as a rule a quarter of one.  Held by
// VideoStages.DifferentiationIsWithinItsBound.
void differentiate_video(std::span<std::uint8_t> video, std::size_t cells, unsigned octaves,
                         unsigned weight, std::vector<std::uint8_t>& scratch);

// Echo stretch.  A cell becomes the largest of `reach` cells to either side and itself.
// reach <= kMaxStretch.  Exact.
inline constexpr unsigned kMaxStretch = 3;
void stretch_video(std::span<std::uint8_t> video, std::size_t cells, unsigned reach,
                   std::vector<std::uint8_t>& scratch);

// Mean of `cells_together` cells, twice: a triangle of 2 n - 1 cells about each, of n n in all.
// Beyond the ends is nothing.  cells_together <= kMostSmoothed; 1 leaves the video as it is.
// Error: half a step of rounding.
inline constexpr unsigned kMostSmoothed = 8;
void smooth_video(std::span<std::uint8_t> video, std::size_t cells, unsigned cells_together,
                  std::vector<std::uint8_t>& scratch);
// The same of an odd number of rows as long as `out`, which may be one of them.
void smooth_rows(std::span<const std::uint8_t* const> rows, std::span<std::uint8_t> out) noexcept;

// video[i] = max(video[i], a[i], b[i]).  Requires a and b to be as long.
void keep_largest(std::span<std::uint8_t> video, std::span<const std::uint8_t> a,
                  std::span<const std::uint8_t> b) noexcept;

// 8-bit video to 4 bits: the upper half of each cell.
void halve_bits(std::span<std::uint8_t> video) noexcept;

// Twins, of one spoke: the means in double, and the plain search.
void differentiate_video_reference(std::span<const std::uint8_t> video, unsigned octaves,
                                   unsigned weight, std::span<double> out);
void stretch_video_reference(std::span<const std::uint8_t> video, unsigned reach,
                             std::span<std::uint8_t> out);
void smooth_video_reference(std::span<const std::uint8_t> video, unsigned cells_together,
                            std::span<double> out);

}  // namespace skerry::echo
