// Small functions that the hulls share.
#pragma once

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {

inline echo::SinCos sin_cos(double radians) {
  return echo::sin_cos_degrees(radians * kDegreesPerRadian);
}
inline double squared(double x) { return x * x; }
inline double cubed(double x) { return x * x * x; }
// e^x for |x| <= 690.
inline double exact_exp(double x) { return echo::exact_exp2(x * 1.4426950408889634); }
// 0 up to `from`, 1 from `to` on, with a continuous slope between.
inline double smooth_step(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The solution of [a b; b2 c] (x, y) = (f, g).
struct Pair {
  double x, y;
};
inline Pair solved(double a, double b, double b2, double c, double f, double g) {
  const double det = a * c - b * b2;
  return {(c * f - b * g) / det, (a * g - b2 * f) / det};
}

}  // namespace skerry::server
