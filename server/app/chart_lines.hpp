// Lines of a chart, cut at a square and thinned.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// The parts of an open line within the square of `half_m` about the origin.
std::vector<std::vector<PlanePoint>> parts_within(const std::vector<PlanePoint>& line,
                                                  double half_m);

// Of each vertex the tolerance, in metres, from which on it may be left out (Ramer, Douglas and
// Peucker): of the vertices above t, no vertex is further than t from the line that those left
// make.  The ends': infinite.  Within kStraight_m of a straight line vertices count for nothing: 0.
// Time: at most n log n; `looked_at` counts the distances that were worked out.
inline constexpr double kStraight_m = 0.05;
std::vector<float> significance(const std::vector<PlanePoint>& line,
                                std::size_t* looked_at = nullptr);

}  // namespace skerry::server
