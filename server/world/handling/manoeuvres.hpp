// Manoeuvres: the trials by which ships are compared.
#pragma once

#include <array>
#include <vector>

#include "server/world/handling/ship_dynamics.hpp"

namespace skerry::server {

// How a trial begins: under way for long enough that speed and shaft agree, in calm water.
struct Trial {
  double depth_m = 1000.0;
  double speed_mps = 0.0;    // at its begin
  double shaft_rps = 0.0;    // at its begin
  double ordered_rps = 0.0;  // all through
  double step_s = 0.1;
  double heading_deg = 0.0;
};
Trial trial_at_service(const ShipClass& ship);

// IMO resolution MSC.137(76), 4.2: from the rudder's order on, at her own origin.
struct TurningCircle {
  double advance_m = 0.0, transfer_m = 0.0;  // at 90 deg of turn
  double tactical_diameter_m = 0.0;          // transfer at 180 deg
  double t90_s = 0.0, t180_s = 0.0, t360_s = 0.0;
  // Of the steady turn, the last of 3600 s.
  double radius_m = 0.0, speed_mps = 0.0, rate_deg_s = 0.0, drift_deg = 0.0, roll_deg = 0.0;
  double greatest_roll_deg = 0.0;
};
TurningCircle turning_circle(const ShipClass& ship, const Trial& trial, double rudder_deg);

// MSC.137(76), 4.3: the rudder is put over whenever the heading is off by `heading_deg`.
struct ZigZag {
  std::vector<double> overshoot_deg;  // first, second, third
  std::vector<double> reversal_s;     // when the rudder was ordered the other way
  double run_to_10_m = 0.0;           // way made until the heading is off by heading_deg
};
ZigZag zig_zag(const ShipClass& ship, const Trial& trial, double rudder_deg, double heading_deg);

// MSC.137(76), 4.4: full astern from the trial's speed.
struct Stopping {
  double track_reach_m = 0.0, time_s = 0.0, head_reach_m = 0.0, side_reach_m = 0.0;
};
Stopping stopping(const ShipClass& ship, const Trial& trial);

}  // namespace skerry::server
