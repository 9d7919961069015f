// ShipDynamics: a ship of a class, integrated in time.
#pragma once

#include <cstdint>

#include "server/world/handling/bank_load.hpp"
#include "server/world/handling/ship_class.hpp"

namespace skerry::server {

// The sea and air about her.  Directions are true, in degrees.
struct Surroundings {
  double wind_from_deg = 0.0, wind_mps = 0.0;       // 10 m above the water, over the ground
  double current_set_deg = 0.0, current_mps = 0.0;  // whither
  double depth_m = 1000.0;
  double wave_height_m = 0.0, waves_from_deg = 0.0;  // significant
  double time_s = 0.0;                               // since the scenario began
  std::uint64_t seed = 0;                            // of the waves
  BankPull banks = {};                               // all of them together
};

// What her wheel, telegraph and thrusters are set to.
struct ActuatorOrders {
  double rudder_deg = 0.0;  // starboard positive
  double shaft_rps = 0.0;   // astern negative
  double bow = 0.0;         // -1 .. 1 of its force, to starboard positive
  double stern = 0.0;
  double rudder_speed = 1.0;  // share of the gear's rate, 0 .. 1; 0: the rudder stays
};

struct DynamicState {
  BodyMotion motion;
  double heading_rad = 0.0;  // true, unbounded
  double rudder_deg = 0.0;
  double shaft_rps = 0.0;
};

// The way made good over the ground in a step, m.
struct WayMade {
  double north_m = 0.0, east_m = 0.0;
};

// Runge-Kutta of fourth order over `step_s` <= 0.2; rudder in closed form.  The wind is that of
// 10 m height (no gradient).  Current moves the water she is in: forces know the water alone.
// The same bits on every machine.  Steps of 0.05 s against steps of 0.005 s: at most 0.05 m off
// after an hour of wild rudder orders; held by ShipDynamics.TwoStepsATickAreAsGoodAsTwenty.
WayMade advance(const ShipClass& ship, const ActuatorOrders& orders, const Surroundings& around,
                double step_s, DynamicState& state);

// Under way at `speed_mps` with the shaft that holds it in calm deep water, rudder amidships.
DynamicState under_way(const ShipClass& ship, double heading_deg, double speed_mps);

}  // namespace skerry::server
