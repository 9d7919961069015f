// OwnShip: how an own ship answers her orders.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// First-order response in equal ticks.  Speed u nears the ordered speed with its time constant,
// exactly: du/dt = (ordered - u) / T_u.  Rate of turn r nears a commanded rate with its own:
// dr/dt = (command - r) / T_r, exactly within a tick, where the command is the course still to turn
// (the shorter way round; to starboard if both are equal) over 4.5 max(T_r, 1 s), at most the
// largest rate of turn, and is set anew each tick.  A loop of gain 1 / 4 T_r is critically damped
// (Nomoto's first-order model under proportional control); 4.5 leaves room for the tick, so she
// does not overshoot an order given on a steady course.
//
// Within a tick she moves as her state says, in a steady turn at steady speed: the means of u and r
// over that tick, so that no spoke sees her jump.  Her position is carried along the rhumb line of
// each tick's chord (GeographicLib); on a steady course that is one rhumb line, to 1 mm in an hour
// at 31 m/s.  Held by OwnShip.ASteadyCourseIsARhumbLine.
// Source: Nomoto et al., "On the steering qualities of ships", ISP 4 (1957).
// Thread: one.
class OwnShip {
 public:
  // Requires what load_scenario() checks.  Under way on her course at her speed, as ordered.
  // Error: std::invalid_argument for a time constant or rate that is not positive.
  OwnShip(const scenario::OwnShip& ship, Duration tick);

  // At the beginning of the tick to come.
  const ShipState& state() const { return state_; }

  // Heeded from the end of the tick to come on.  Absent: as before.  Course in degrees, any turn.
  // Error: std::invalid_argument if not finite.
  void order(std::optional<double> course_deg, std::optional<double> speed_mps);

  // One tick on.
  void step();

  // `ticks` on, at the cost of at most kFineTicks and one stride: tick by tick until she holds her
  // course or kFineTicks have passed, then at once.  Speed and distance are exact; a turn that is
  // still going on after kFineTicks is taken as finished.
  void leap(std::int64_t ticks);
  static constexpr std::int64_t kFineTicks = 600;

 private:
  double course_error_deg() const;  // (-180, 180]
  void plan();                      // the tick to come

  double tick_s_;
  double speed_time_constant_s_, turn_time_constant_s_, max_rate_deg_s_;
  double speed_decay_, turn_decay_;  // exp(-tick / T)
  double speed_mean_, turn_mean_;    // mean of exp(-t / T) over a tick
  double speed_now_mps_, rate_now_deg_s_ = 0.0;
  double speed_next_mps_ = 0.0, rate_next_deg_s_ = 0.0;  // at the end of the tick to come
  ShipState state_;
};

}  // namespace skerry::server
