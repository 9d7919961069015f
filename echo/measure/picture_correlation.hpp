// How alike neighbouring cells of a coast's echo are.
#pragma once

#include <array>

#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

inline constexpr std::array<std::uint32_t, 6> kCorrelationLags = {1, 2, 4, 8, 16, 32};

// Correlation of the values of two cells so many spokes, or cells, apart, over the pairs of which
// both echo (value at least 1).  NaN where there are none.  Source of the measure: SOURCES.md
// "Pictures" (f).
struct PictureCorrelation {
  std::array<double, 6> spoke{};  // by kCorrelationLags
  std::array<double, 6> range{};
};

// Error: std::invalid_argument as require_valid().  window.threshold is not looked at.
PictureCorrelation picture_correlation(const PictureTurn& turn, const PictureWindow& window);

// The same of the mean of several turns of one size, over cells whose mean is at least `least`.
// Speckle that is new every turn averages out, so it is higher.
PictureCorrelation mean_picture_correlation(std::span<const PictureTurn> turns,
                                            const PictureWindow& window, double least);

}  // namespace skerry::echo
