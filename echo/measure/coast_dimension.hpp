// How rough a charted coast is, by the divider.
#pragma once

#include <span>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Length of a line measured with a ruler.
struct RulerLength {
  double ruler_m = 0.0;
  double length_m = 0.0;  // steps and what is left at the ends, times the ruler
};

// With eight rulers from the shortest to the longest in equal ratios; each length is the mean of
// eight starting vertices spread over the line, walked from both ways (Klinkenberg 1994).
// Takes 16 walks of the line per ruler.  Empty for rulers that are not positive and ascending, for
// fewer than two vertices, and for a line that would take more than 1e8 steps.
// Arithmetic: the same bits on every machine.
std::vector<RulerLength> divider_lengths(std::span<const PlanePoint> line, double shortest_ruler_m,
                                         double longest_ruler_m);

// Slope of log length over log ruler: D = 1 - slope.  NaN for fewer than two lengths.
double dimension_of(std::span<const RulerLength> lengths);

// Fractal dimension of a polyline: both of the above.  NaN where the line is shorter than 4 of the
// longest ruler.  Bias on a Koch curve of 1.262: -0.04 to +0.01 by the rulers (+0.04 from one start
// alone, SOURCES.md "Fractals"); none on a straight line; on a graph it finds the D of the graph
// only where rulers are shorter than it is high.  Held by Divider.FindsKochsDimensionWithinItsBias.
double divider_dimension(std::span<const PlanePoint> line, double shortest_ruler_m,
                         double longest_ruler_m);

}  // namespace skerry::echo
