#include "echo/targets/ship_sight.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

ShipSight sight_of(const Hull& hull, const SectorView& view) {
  ShipSight sight;
  const PlanePoint p = view.from_own_ship(hull.centre, hull.velocity);
  sight.from_own_ship = p;
  sight.at = polar_of(p);
  const double heading = hull.heading_deg + hull.turn_rate_deg_s * view.dt();
  sight.bow = sin_cos_degrees(heading);
  const double range = std::max(1.0, sight.at.range_m);
  sight.ahead = std::min(1.0, std::fabs(ahead_of(sight.bow, p)) / range);
  sight.side = std::min(1.0, std::fabs(right_of(sight.bow, p)) / range);
  sight.aspect_units =
      sight.at.units + kUnitsPerHalfTurn - TrueBearing::from(degrees(heading)).units();
  return sight;
}

}  // namespace skerry::echo
