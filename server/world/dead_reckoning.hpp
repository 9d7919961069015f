// Dead reckoning: where a ship is within a tick.
#pragma once

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

struct ShipPlace {
  GeoPoint position;
  double heading_deg = 0.0;             // true, [0, 360)
  double course_over_ground_deg = 0.0;  // true, [0, 360)
  bool over_pole = false;               // both were reversed at a pole (rhumb_step.hpp)
};

// Chord over arc of a turn: sin(x) / x, x half the turn.
double chord_of_arc(double turn_deg);

// The ship `dt` on the air (of either sign) after the state's time, if she keeps her speed and rate
// of turn: by the chord of the arc she turns through, along the rhumb line on her mean course.  One
// tick on, it is the own ship's next position, bit for bit.
//
// Error: against the true arc 1e-6 m over 0.2 s, at up to 31 m/s, 12 deg/s and 85 deg of latitude.
// Held by DeadReckoning.MatchesAFinelySteppedGeodesic.
// A target on a waypoint leg follows a geodesic, which the rhumb line leaves by
// (speed dt)^2 tan(latitude) / 2R: 1e-5 m over 0.2 s at 31 m/s and 70 deg.  At a waypoint, and
// where she stops, the target is right again with the next tick: off by up to twice the way of a
// tick. Thread: any.  Cost: about 1 us.
ShipPlace position_at(const ShipState& ship, Duration dt);

}  // namespace skerry::server
