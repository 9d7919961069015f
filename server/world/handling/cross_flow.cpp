#include "server/world/handling/cross_flow.hpp"

namespace skerry::server {

Loads cross_flow(const BodyMotion& motion, double length_m, double draught_m) {
  constexpr int kStrips = 10;
  constexpr double kDrag = 0.8;
  double force = 0.0, moment = 0.0;
  for (int i = 0; i < kStrips; ++i) {
    const double x = length_m * ((i + 0.5) / kStrips - 0.5);
    const double across = motion.v + x * motion.r;
    const double push = std::fabs(across) * across / kStrips;
    force += push;
    moment += push * x;
  }
  const double unit = -0.5 * kSeaWater_kg_m3 * kDrag * length_m * draught_m;
  return {.y = unit * force, .n = unit * moment};
}

}  // namespace skerry::server
