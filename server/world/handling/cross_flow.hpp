// Cross-flow drag: what a hull that moves broadside meets.
#pragma once

#include "server/world/handling/hull.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {

// A hull is cut into ten strips; each resists the water that crosses it, with a drag coefficient
// of 0.8 (assumed).  Holds at rest, adrift and turning on the spot.
Loads cross_flow(const BodyMotion& motion, double length_m, double draught_m);

// 0 for a hull that moves along herself, 1 for one that moves broadside, from 30 to 50 deg of
// drift, or spins, from r L / U of 1 to 1.6: by so much our hulls are cross-flow drag instead of
// their sources' series.
inline double broadside(const BodyMotion& motion, double length_m) {
  const double way = std::max(std::sqrt(squared(motion.u) + squared(motion.v)), 1e-3);
  return std::max(smooth_step(std::fabs(motion.v) / way, 0.5, 0.766),
                  smooth_step(std::fabs(motion.r) * length_m / way, 1.0, 1.6));
}

}  // namespace skerry::server
