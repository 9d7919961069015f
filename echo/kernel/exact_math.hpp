// Elementary functions that give the same bits on every machine.
//
// glibc's double sin, cos, atan2, log and exp differ in the last bit with and without FMA.  One bit
// can move an echo over a cell's border, so what decides the video uses these instead: plain
// arithmetic and sqrt only, compiled without contraction.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

// The part of `v` along a direction and the part to its right, of a clockwise angle from north.
inline double ahead_of(SinCos direction, PlanePoint v) {
  return v.east_m * direction.sin + v.north_m * direction.cos;
}
inline double right_of(SinCos direction, PlanePoint v) {
  return v.east_m * direction.cos - v.north_m * direction.sin;
}
// `v` turned clockwise.
inline PlanePoint turned(PlanePoint v, SinCos angle) {
  return {v.east_m * angle.cos + v.north_m * angle.sin,
          v.north_m * angle.cos - v.east_m * angle.sin};
}

// Error: 4e-16 absolute for |degrees| <= 1e6.  Exact at multiples of 90.  Held by
// ExactMath.SineAndCosineAreCloseToLibm.
SinCos sin_cos_degrees(double degrees);

// A binary angle, 2^32 = one turn.
SinCos sin_cos_units(std::uint32_t units);

// Radians in (-pi, pi]; 0 for (0, 0).  Error: 1e-15.
double exact_atan2(double y, double x);

// Base-2 logarithm of a positive, normal x.  Error: 2e-15 relative or absolute, the larger.
double exact_log2(double x);

// 2^x for |x| <= 1000.  Error: 1e-15 relative.
double exact_exp2(double x);

inline constexpr double kOctavesPerDb = 0.33219280948873623;  // log2(10) / 10

// 10^(db/10) and its inverse, from the two above.
double ratio_from_decibels(double db);
double decibels_from_ratio(double ratio);

}  // namespace skerry::echo
