// A ruler walked along a line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

inline double distance(PlanePoint a, PlanePoint b) { return length_of(b - a); }

// From vertex `start` to the end: each foot is where the line first leaves the circle of radius
// `ruler_m` about the foot before.  visit(segment, foot) for every foot after the first, on the
// segment from line[segment] to the next vertex.  Gives what is left from the last foot to the end
// of the line, in rulers, below 1.
// Requires start < line.size(), ruler_m > 0, finite coordinates.
template <typename Visit>
double walk_ruler(std::span<const PlanePoint> line, std::size_t start, double ruler_m,
                  Visit&& visit) {
  PlanePoint foot = line[start];
  for (std::size_t i = start; i + 1 < line.size(); ++i) {
    PlanePoint a = line[i];
    const PlanePoint b = line[i + 1];
    while (distance(foot, b) >= ruler_m) {
      // |a + t (b - a) - foot| = ruler
      const PlanePoint u = b - a, v = a - foot;
      const double uu = dot(u, u);
      const double uv = dot(u, v);
      const double vv = dot(v, v) - ruler_m * ruler_m;
      if (!(uu > 0.0)) break;
      const double t = (-uv + std::sqrt(std::max(0.0, uv * uv - uu * vv))) / uu;
      foot = a + u * std::clamp(t, 0.0, 1.0);
      if (foot == a) foot = b;  // a ruler shorter than the coordinates can tell apart
      a = foot;
      visit(i, foot);
    }
  }
  return distance(foot, line.back()) / ruler_m;
}

}  // namespace skerry::echo
