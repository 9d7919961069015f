// Machinery: what of a ship's machinery does not work.
#pragma once

#include "server/world/handling/ship_dynamics.hpp"

namespace skerry::server {

// Orders stay as they are given, and act again when the fault is gone.
struct Machinery {
  bool steering_lost = false;      // the rudder stays where it is
  bool steering_one_pump = false;  // it moves half as fast
  bool engine_tripped = false;     // as if the shaft were ordered to stop: it runs down by its lag
  bool thrusters_lost = false;     // bow and stern
};

// What acts on her of what is ordered.
inline ActuatorOrders acting(const Machinery& machinery, ActuatorOrders ordered) {
  if (machinery.steering_one_pump) ordered.rudder_speed = 0.5;
  if (machinery.steering_lost) ordered.rudder_speed = 0.0;
  if (machinery.engine_tripped) ordered.shaft_rps = 0.0;
  if (machinery.thrusters_lost) ordered.bow = ordered.stern = 0.0;
  return ordered;
}

}  // namespace skerry::server
