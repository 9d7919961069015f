#include "server/world/dead_reckoning.hpp"

#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/rhumb_step.hpp"

namespace skerry::server {

double chord_of_arc(double turn_deg) {
  const double x = turn_deg * (0.5 * kRadiansPerDegree);
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : echo::sin_cos_degrees(0.5 * turn_deg).sin / x;
}

ShipPlace position_at(const ShipState& ship, Duration dt) {
  const double dt_s = in_seconds(dt) * ship.pace;
  const double turn_deg = ship.rate_of_turn_deg_s * dt_s;
  const RhumbEnd end = advanced(ship.position, ship.course_over_ground_deg + 0.5 * turn_deg,
                                ship.speed_mps * dt_s * chord_of_arc(turn_deg));
  const double turned_deg = turn_deg + (end.over_pole ? 180.0 : 0.0);
  return {end.position, wrapped_degrees(ship.heading_deg + turned_deg),
          wrapped_degrees(ship.course_over_ground_deg + turned_deg), end.over_pole};
}

}  // namespace skerry::server
