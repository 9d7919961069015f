// The steering gear: how the rudder follows its order.
#pragma once

namespace skerry::server {

struct SteeringGear {
  double rate_deg_s = 2.33;  // IMO MSC.137(76) asks for 35 to 30 deg the other way within 28 s
  double limit_deg = 35.0;
  double lag_s = 0.0;  // of a first-order servo, within its rate; 0: none
};

// The rudder's angle `after_s` >= 0 seconds later, in closed form: it runs at its rate until the
// lag would ask for less, then settles exponentially.  Degrees, starboard positive.  The order is
// kept within the gear's limit.  A gear without a rate leaves the rudder where it is.
double rudder_after(const SteeringGear& gear, double angle_deg, double order_deg, double after_s);

}  // namespace skerry::server
