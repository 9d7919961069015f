// Courses, bearings and speeds of vectors east and north.
#pragma once

#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Degrees in [0, 360); 0 of no length.
inline double direction_of(PlanePoint v) {
  return wrapped_degrees(echo::exact_atan2(v.east_m, v.north_m) * kDegreesPerRadian);
}

inline PlanePoint vector_of(double direction_deg, double length) {
  const echo::SinCos direction = echo::sin_cos_degrees(direction_deg);
  return {direction.sin * length, direction.cos * length};
}

// The smaller turn between two directions, degrees in [0, 180].
inline double degrees_apart(double a_deg, double b_deg) {
  return std::fabs(std::remainder(a_deg - b_deg, 360.0));
}

inline bool is_finite(PlanePoint v) { return std::isfinite(v.east_m) && std::isfinite(v.north_m); }

inline bool is_on_the_earth(GeoPoint place) {
  return std::fabs(place.latitude_deg) <= 90.0 && std::fabs(place.longitude_deg) <= 180.0;
}

}  // namespace skerry::server
