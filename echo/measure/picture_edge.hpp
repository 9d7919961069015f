// The leading edge of a coast's echo, and how thick the echo behind it is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// The first stretch of echo on a spoke that is not a speck.
struct FirstEcho {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t begin = kNone, end = kNone;  // cells [begin, end)
  std::uint32_t last = kNone;                // one past the last echo on the spoke
};

// First echoes of the window's spokes, in order.  A stretch shorter than kLeastEcho_m is a speck; a
// single silent cell does not end it.  A window that begins on land sees what it is inside of.
inline constexpr double kLeastEcho_m = 15.0;
std::vector<FirstEcho> first_echoes(const PictureTurn& turn, const PictureWindow& window);

// p10, p25, p50, p75, p90.
using Quantiles = std::array<double, 5>;
Quantiles quantiles_of(std::vector<double> values);  // NaN where there are none

// Source of the measures, and what real pictures have: SOURCES.md "Pictures (b), (c)".
struct EdgeStatistics {
  std::uint32_t spokes = 0;   // with a first echo
  double mean_range_m = 0.0;  // of the first echoes' begin
  Quantiles thickness_m{};    // of the first contiguous echo
  Quantiles first_to_last_m{};
  // Change of the first echo's begin from spoke to spoke.
  double within_a_cell = 0.0;  // share of changes of at most one cell
  double change_p99_m = 0.0;
  double jumps = 0.0;  // share of changes over 100 m
};

// Error: std::invalid_argument as require_valid().
EdgeStatistics edge_statistics(const PictureTurn& turn, const PictureWindow& window);

}  // namespace skerry::echo
