#include "server/world/bank_effect.hpp"

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {

namespace {

// As if it were to starboard.
struct Side {
  BankPull pull;          // the strongest so far
  double ceiling = 1e30;  // of the sway that walls from here on can have

  void take(const NearWall& wall, double share, const BankShape& shape, double depth_m) {
    if (share * ceiling <= pull.sway) return;
    const BankPull whole = wall_pull(shape, wall.distance_m, depth_m);
    // The farther, the weaker.
    if (wall.distance_m >= bank_nearest_m(shape)) ceiling = whole.sway;
    if (share * whole.sway > pull.sway) pull = {share * whole.sway, share * whole.yaw};
  }
};

}  // namespace

BankPull pull_of(const Banks& banks, const BankShape& shape, GeoPoint at, double heading_deg,
                 double depth_m) {
  const std::vector<NearWall> walls = banks.near(at, bank_reach_m(shape));
  if (walls.empty()) return {};
  const echo::SinCos heading = echo::sin_cos_degrees(heading_deg);
  const PlanePoint starboard{heading.cos, -heading.sin};
  Side right, left;
  for (const NearWall& wall : walls) {
    const double abeam = dot(wall.way, starboard) / wall.distance_m;
    Side& side = abeam > 0.0 ? right : left;
    side.take(wall, abeam * abeam * wall.share, shape, depth_m);
  }
  return {right.pull.sway - left.pull.sway, right.pull.yaw - left.pull.yaw};
}

}  // namespace skerry::server
