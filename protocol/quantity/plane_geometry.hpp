// Distances in the plane; plain arithmetic and sqrt, the same bits everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "protocol/quantity/geo_point.hpp"

namespace skerry {

// Metres per degree of latitude on a sphere of 6371 km.  Error: 0.6 % (110.6 km at the equator,
// 111.7 at the poles).
inline constexpr double kMeanMetresPerDegree = 111195.0;

// Square of the distance from `p` to the segment from `a` to `b`, which may be one point.
constexpr double distance_squared_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a, ap = p - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
  const PlanePoint d = ap - ab * t;
  return dot(d, d);
}

inline double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  return std::sqrt(distance_squared_to_segment(p, a, b));
}

// Length of the line through these points, from the first to the last.
inline double length_of(std::span<const PlanePoint> line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += length_of(line[i] - line[i - 1]);
  return sum;
}

}  // namespace skerry
