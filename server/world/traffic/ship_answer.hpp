// How a ship of the traffic answers: rate of turn and speed follow what is wanted with a lag.
#pragma once

#include "server/world/traffic/traffic_class.hpp"

namespace skerry::server {

// All positive.
struct ShipAnswer {
  double turn_s, speed_s;  // time constants
  double most_rate_deg_s;
  double service_mps, most_mps;

  // What she can: all of it with a third of her service speed or more, less with less way, for then
  // it is her circle that stays; but as much as thrusters and a kick ahead give a ship at rest.
  double rate_limit_deg_s(double speed_mps) const;
  // How hard she brakes in the ordinary way, m/s2.
  double braking() const { return service_mps / (4.0 * speed_s); }
};

struct WayAndTurn {
  double speed_mps = 0.0;
  double rate_deg_s = 0.0;
};

// What is wanted of her over a tick.
struct Wanted {
  double left_deg = 0.0;  // to turn, starboard positive
  double speed_mps = 0.0;
  double brake_mps2 = 0.0;     // above 0: she loses way evenly, whatever the speed wanted
  double share_of_rate = 1.0;  // of what she can turn
};

// Means over the tick, and what she has at its end.
struct TickMotion {
  WayAndTurn mean, end;
};

// As OwnShip: rate of turn and speed by first order, the rate wanted in proportion to what is left
// so that the turn is critically damped; closed forms over the tick.
TickMotion tick_motion(const ShipAnswer& answer, WayAndTurn now, const Wanted& wanted,
                       double tick_s);

// How far ahead of a waypoint she puts her wheel over so that the turn ends on the next leg: the
// turn is sailed in steps of a second.  From 120 deg on less and less, down to nothing.
// Error: under 5 % of the radius of her turn, up to 120 deg.  Held by
// TrafficShip.TurnsAtAWaypointWithoutOvershoot.
double wheel_over_m(const ShipAnswer& answer, double speed_mps, double turn_deg);

}  // namespace skerry::server
