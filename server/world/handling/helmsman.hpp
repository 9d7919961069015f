// Helmsman: who steers and minds the engine, tick by tick.
#pragma once

#include <cstdint>
#include <vector>

#include "server/world/handling/ship_dynamics.hpp"

namespace skerry::server {

enum class SteeringMode : std::uint8_t {
  hand,     // the rudder is where the wheel is
  heading,  // the autopilot keeps a heading
  track,    // the autopilot keeps her on her route
};

// A leg's end, in the plane of the ship: m to the north and east of her.
struct RoutePoint {
  double north_m = 0.0, east_m = 0.0;
};

// What the helmsman knows of her track in this tick.  Without a next leg she ends there.
struct TrackView {
  RoutePoint from, to;
  bool has_next = false;
  RoutePoint next = {};
};

// What is ordered; in force until changed.
struct HelmOrders {
  SteeringMode steering = SteeringMode::hand;
  double wheel_deg = 0.0;    // hand: the rudder's order
  double heading_deg = 0.0;  // heading: true
  // The engine: a lever, or a speed through the water that is kept.
  bool keeps_speed = false;
  double lever = 0.0;  // -1 full astern .. 1 full ahead, in proportion of the shaft's turns
  double speed_mps = 0.0;
  double bow = 0.0, stern = 0.0;  // thrusters, -1 .. 1, to starboard positive
  double most_rate_deg_s = 0.0;   // of the autopilot's turns; 0: as her class has it
  double turn_radius_m = 0.0;     // of the track's turns; 0: four lengths
};

// The autopilot turns at a rate in proportion to the heading left to turn, at most that ordered,
// and gives rudder in proportion to the rate that is missing, with an integral that takes out
// wind and a ship that does not keep her course.  Gains follow from length and speed.  Its rudder
// is at most 35 deg, and 10 deg less than her gear's limit on a straight course is never needed.
// On a track it steers for a point five to twelve lengths ahead on the leg, corrected by the drift
// that it sees, and puts the wheel over R tan(turn / 2) plus her delay before the leg's end.
// One per ship; its state is a part of the ship's.  Called once a tick, so that an integration in
// finer steps sees the same orders.
class Helmsman {
 public:
  // The orders to wheel, shaft and thrusters for the coming tick of `tick_s`.  `ground`: her way
  // over ground in the last tick, per second.  `track` only in mode track; sets `over` where the
  // leg's end is so near that the wheel is put over for the next.
  ActuatorOrders orders(const ShipClass& ship, const DynamicState& state, const HelmOrders& helm,
                        const WayMade& ground, const TrackView* track, double tick_s, bool& over);
  // Where the autopilot takes over, or after a jump.
  void reset() { *this = Helmsman(); }

 private:
  double rudder_for(const ShipClass& ship, const DynamicState& state, double left_rad,
                    double most_rate_rad, double tick_s);
  double shaft_order(const ShipClass& ship, const DynamicState& state, const HelmOrders& helm,
                     double tick_s);

  double integral_deg_ = 0.0;  // of rudder
  double trim_rps_ = 0.0;
};

// How fast the ship's class is turned by the autopilot, deg/s: on a circle of four lengths.
double usual_rate_deg_s(const ShipClass& ship, double speed_mps);

}  // namespace skerry::server
