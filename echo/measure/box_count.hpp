// Box counting of outlines.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "echo/measure/line_fit.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

using PlaneLine = std::vector<PlanePoint>;

// How many boxes of each size the lines pass through: the least of four grids, the second to fourth
// moved by half a box.  Exact: every box a segment enters counts.
struct BoxCensus {
  std::vector<double> sizes_m;     // ascending
  std::vector<std::size_t> boxes;  // by size
  // The same by tile of twice the largest box, for the bootstrap: [tile][size].
  std::vector<std::vector<std::size_t>> tiles;
};

// Sizes: `smallest_m`, doubled up to `largest_m` at most.
// Error: std::invalid_argument for sizes that are not positive and ascending, for coordinates that
// are not finite, and where the smallest size would take more than 5e7 boxes.
BoxCensus box_census(std::span<const PlaneLine> lines, double smallest_m, double largest_m);

// D by scale: log2(N(s) / N(2 s)) at s sqrt(2), one per size but the last.
struct ScaleDimension {
  double scale_m = 0.0;
  double dimension = 0.0;
};
std::vector<ScaleDimension> local_dimensions(const BoxCensus& census);

// Slope of log N over -log s.  The standard error is the larger of that of the regression and that
// of a bootstrap of the tiles; the interval is twice (Student, n - 2) that to both sides.  Bias:
// -0.02 on a Koch curve of 1.262, -0.1 on graphs of D 1.4, -0.05 of 1.25 (SOURCES.md "Fractals"):
// never judge a D by box counting closer than 0.1. NaN where fewer than three sizes hold a box.
DimensionEstimate box_dimension(const BoxCensus& census);

}  // namespace skerry::echo
