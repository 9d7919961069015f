// Distances in the plane; plain arithmetic and sqrt, the same bits everywhere.
#pragma once

#include <algorithm>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Metres per degree of latitude on a sphere of 6371 km.  Error: 0.6 % (110.6 km at the equator,
// 111.7 at the poles).
inline constexpr double kMeanMetresPerDegree = 111195.0;

inline double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a, ap = p - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
  return length_of(ap - ab * t);
}

}  // namespace skerry::echo
