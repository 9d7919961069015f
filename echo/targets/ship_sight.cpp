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
  const double along = p.east_m * sight.bow.sin + p.north_m * sight.bow.cos;
  const double across = p.east_m * sight.bow.cos - p.north_m * sight.bow.sin;
  sight.ahead = std::min(1.0, std::fabs(along) / range);
  sight.side = std::min(1.0, std::fabs(across) / range);
  sight.aspect_units = sight.at.units + 0x80000000u - TrueBearing::from(degrees(heading)).units();
  return sight;
}

}  // namespace skerry::echo
