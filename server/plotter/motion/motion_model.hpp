// MotionModel: how a target's state goes on by itself.
#pragma once

#include "server/plotter/motion/motion_state.hpp"

namespace skerry::server {

struct MotionModel {
  // Spectral density of a white acceleration, m^2/s^3: after t seconds the velocity of each axis
  // has a standard deviation of sqrt(density * t).
  double acceleration = 0.0;
  // It turns: the rate of turn stays but for a white noise of this density, rad^2/s^3.
  bool turns = false;
  double turn_change = 0.0;
  // It does not turn: so much a turn that begins now may be, rad/s (standard deviation).
  double turn_ahead = 0.0;
};

// The state `seconds` later, 0 to 600; in steps of at most kLongestStep, so that the turn's
// linearization holds.
inline constexpr double kLongestStep_s = 4.0;
void predict(MotionState& state, const MotionModel& model, double seconds);

}  // namespace skerry::server
