// Whether outlines of ships touch, the slow way: points along the one, looked for within the other.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server::slow {

struct Hull {
  PlanePoint middle;
  double length_m = 0.0, beam_m = 0.0, heading_deg = 0.0;
};

// The outline as it is described: parallel sides to a quarter behind the bow, a pointed bow.
inline bool has(const Hull& hull, PlanePoint place) {
  const double heading = hull.heading_deg * std::numbers::pi / 180.0;
  const double east = place.east_m - hull.middle.east_m;
  const double north = place.north_m - hull.middle.north_m;
  const double ahead = east * std::sin(heading) + north * std::cos(heading);
  const double right = std::fabs(east * std::cos(heading) - north * std::sin(heading));
  const double half = hull.length_m / 2.0, side = hull.beam_m / 2.0;
  if (ahead < -half || ahead > half) return false;
  const double taper = (half - ahead) / (hull.length_m / 4.0);  // 0 at the bow's point
  return right <= (taper < 1.0 ? side * taper : side);
}

inline std::vector<PlanePoint> edge_of(const Hull& hull, double spacing_m) {
  const double half = hull.length_m / 2.0, side = hull.beam_m / 2.0;
  const double shoulder = half - hull.length_m / 4.0;
  const double corners[5][2] = {
      {0.0, half}, {side, shoulder}, {side, -half}, {-side, -half}, {-side, shoulder}};
  const double heading = hull.heading_deg * std::numbers::pi / 180.0;
  std::vector<PlanePoint> points;
  for (int i = 0; i < 5; ++i) {
    const double* from = corners[i];
    const double* to = corners[(i + 1) % 5];
    const int count =
        1 + static_cast<int>(std::hypot(to[0] - from[0], to[1] - from[1]) / spacing_m);
    for (int k = 0; k < count; ++k) {
      const double share = static_cast<double>(k) / count;
      const double right = from[0] + share * (to[0] - from[0]);
      const double ahead = from[1] + share * (to[1] - from[1]);
      points.push_back(
          {hull.middle.east_m + right * std::cos(heading) + ahead * std::sin(heading),
           hull.middle.north_m - right * std::sin(heading) + ahead * std::cos(heading)});
    }
  }
  return points;
}

inline bool touch(const Hull& a, const Hull& b, double spacing_m) {
  const double apart_m =
      std::hypot(b.middle.east_m - a.middle.east_m, b.middle.north_m - a.middle.north_m);
  // No point of an outline is farther from its middle than half its length and half its beam
  // together.
  if (apart_m > (a.length_m + a.beam_m + b.length_m + b.beam_m) / 2.0) return false;
  for (const PlanePoint point : edge_of(a, spacing_m)) {
    if (has(b, point)) return true;
  }
  for (const PlanePoint point : edge_of(b, spacing_m)) {
    if (has(a, point)) return true;
  }
  return false;
}

}  // namespace skerry::server::slow
