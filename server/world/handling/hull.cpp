#include "server/world/handling/hull.hpp"

namespace skerry::server {

double shaft_for(const Hull& hull, double speed_mps) {
  constexpr double kFastest_rps = 100.0, kDeep_m = 1e6;
  if (speed_mps == 0.0) return 0.0;
  double low = -kFastest_rps, high = kFastest_rps;
  const BodyMotion straight{.u = speed_mps};
  for (int i = 0; i < 60; ++i) {
    const double n = 0.5 * (low + high);
    (hull.change(straight, {0.0, n}, kDeep_m, {}).u < 0.0 ? low : high) = n;
  }
  return 0.5 * (low + high);
}

}  // namespace skerry::server
