// Products and lengths of vectors in the plane; plain arithmetic and sqrt, the same bits
// everywhere.
#pragma once

#include <cmath>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

inline double dot(PlanePoint a, PlanePoint b) {
  return a.east_m * b.east_m + a.north_m * b.north_m;
}
inline double length_of(PlanePoint v) { return std::sqrt(dot(v, v)); }

}  // namespace skerry::echo
