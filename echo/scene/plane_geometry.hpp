// Lengths and distances in the plane; plain arithmetic and sqrt, the same bits everywhere.
#pragma once

#include <algorithm>
#include <cmath>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

inline double dot(PlanePoint a, PlanePoint b) {
  return a.east_m * b.east_m + a.north_m * b.north_m;
}
inline double length_of(PlanePoint v) { return std::sqrt(dot(v, v)); }

inline double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a, ap = p - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
  return length_of(ap - ab * t);
}

}  // namespace skerry::echo
