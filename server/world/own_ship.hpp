// OwnShip: an own ship's motion, tick by tick.
#pragma once

#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/world/class_ship.hpp"
#include "server/world/driven_motion.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// First-order response to orders.
//   speed v:         dv/dt = (ordered speed - v) / T_v
//   rate of turn r:  dr/dt = (commanded rate - r) / T_r, commanded rate = K * course left to turn,
//                    at most the ship's largest rate; T_v, T_r and that rate from the scenario.
// K = 1 / 4 (T_r + tick) makes the turn critically damped, so that it does not overshoot; it turns
// the shorter way (starboard if exactly opposite).  An order that comes amid a turn may be overshot
// by what the ship cannot help: up to r T_r.
//
// A ship without way turns as well: bow thrusters.  Heading and course over ground are one: there
// is no set nor drift yet, unless she is driven.  Over a pole the ship goes straight on, and her
// ordered course is reversed with her heading.
//
// The commanded rate is held over a tick; within that, speed and rate of turn are integrated
// exactly: state() gives their means over the coming tick, and the ship moves by position_at() of
// that very state.  So the way made since an order is the closed form's to rounding, and neither
// position nor heading ever jumps between ticks.
// Error: a turn of 120 deg at 24 kn ends 0.14 m from the same turn in ticks of 1 ms, for the
// commanded rate is held over a tick; on a steady course see rhumb_step.hpp.
// Held by OwnShip.TurnsAsInFineTicks and OwnShip.ApproachesTheOrderedSpeedExponentially.
//
// A ship that has a class (ClassShip) answers rudder, engine, wind, waves and current instead.
//
// Faults of her machinery: with the engine tripped her ordered speed acts as 0; with the steering
// gear lost the commanded rate of turn stays as it was, so she goes on straight or in her turn. One
// pump or no thrusters make no difference to a ship without a class.  Orders stay, and act again
// after.
//
// Aground she lies still; her rudder and engine go on as ordered.
//
// While fixes of an outside simulator come, they drive her instead (driven_motion.hpp).  After the
// last she goes on by herself, on the heading and at the speed she had.
//
// No value is ever NaN: a time constant of 0 is an immediate response.  Thread: one at a time.
class OwnShip {
 public:
  // Under way on her course and speed, both ordered.
  // `seed` is that of the waves she feels.
  OwnShip(const scenario::OwnShip& ship, const Environment& environment, Duration tick,
          std::uint64_t seed);

  // Take effect with the tick after the present one.  `course_deg` is any finite number of degrees.
  void order_course(double course_deg);
  void order_speed(double speed_mps);
  // Error: what is wrong; nothing is then ordered.
  std::optional<std::string> fault_of(const wire::ConOrder& order) const;
  void order(const wire::ConOrder& order);

  // Her state at `now`, since scenario time 0; takes effect with the next tick.  Requires finite
  // values within their ranges.  True if she was not driven until now.
  bool drive(const OwnShipFix& fix, Duration now);

  // At `there`'s position, on its heading and at its speed, from now on; she keeps both.  Aground
  // if it is.
  void put(const ShipState& there, const Environment& environment);

  // Where `there` has her, on its heading: she lies still from now on, whatever is ordered, until
  // put() has her elsewhere.  Requires that she is not driven.
  void run_aground(const ShipState& there);

  // What is wrong aboard her from now on, instead of what was.
  void set_faults(const wire::Faults& faults);
  wire::Faults faults() const { return state_.faults ? state_.faults->faults : wire::Faults{}; }

  // The present tick: motion means from its begin to its end, orders as they took effect.
  ShipState state() const { return state_; }
  void step(const Environment& environment);

 private:
  // Relaxation towards a goal over a tick.
  struct Lag {
    Lag(double time_constant_s, double tick_s);
    double end(double value, double goal) const { return goal + (value - goal) * kept; }
    double mean(double value, double goal) const { return goal + (value - goal) * mean_kept; }
    double kept;       // of the difference at the end of the tick
    double mean_kept;  // of the difference on the average of the tick
  };
  void begin_tick(const Environment& environment);
  void end_drive(const Environment& environment);
  void hold_what_is_lost(const FaultState* was, FaultState& next) const;
  void go_on(const Environment& environment);
  void lie_still();

  Duration tick_;
  Lag speed_lag_, turn_lag_;
  double turn_gain_;  // 1/s
  double max_rate_deg_s_;
  double ordered_course_deg_, ordered_speed_mps_;
  double speed_mps_, rate_deg_s_ = 0.0;  // at the begin of the tick
  double end_speed_mps_, end_rate_deg_s_ = 0.0;
  double commanded_deg_s_ = 0.0;  // rate of turn
  ShipState state_;
  Duration now_{};  // begin of the present tick
  std::optional<DrivenMotion> driven_;
  std::optional<ClassShip> class_ship_;
};

}  // namespace skerry::server
