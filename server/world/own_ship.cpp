#include "server/world/own_ship.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "server/world/motion.hpp"

namespace skerry::server {
namespace {

double positive(double value, const char* key, const std::string& ship) {
  if (std::isfinite(value) && value > 0.0) return value;
  throw std::invalid_argument(
      fmt::format("own ship \"{}\": {} is {}; allowed: more than 0", ship, key, value));
}

double finite(double value, const char* what, const std::string& ship) {
  if (std::isfinite(value)) return value;
  throw std::invalid_argument(fmt::format(
      "own ship \"{}\": ordered {} is {}; allowed: a finite number", ship, what, value));
}

// (1 - exp(-x)) / x
double mean_decay(double x) { return -std::expm1(-x) / x; }

}  // namespace

OwnShip::OwnShip(const scenario::OwnShip& ship, Duration tick)
    : tick_s_(in_seconds(tick)),
      speed_time_constant_s_(
          positive(ship.speed_time_constant_s(), "speed_time_constant_s", ship.name())),
      turn_time_constant_s_(
          positive(ship.turn_time_constant_s(), "turn_time_constant_s", ship.name())),
      max_rate_deg_s_(
          positive(ship.max_rate_of_turn_deg_min(), "max_rate_of_turn_deg_min", ship.name()) /
          60.0),
      speed_decay_(std::exp(-tick_s_ / speed_time_constant_s_)),
      turn_decay_(std::exp(-tick_s_ / turn_time_constant_s_)),
      speed_mean_(mean_decay(tick_s_ / speed_time_constant_s_)),
      turn_mean_(mean_decay(tick_s_ / turn_time_constant_s_)),
      speed_now_mps_(ship.speed_kn() * kMetresPerSecondPerKnot) {
  state_.name = ship.name();
  state_.position = {ship.position().lat(), wrapped_longitude(ship.position().lon())};
  state_.heading_deg = wrapped_course(ship.course_deg());
  state_.ordered_course_deg = state_.heading_deg;
  state_.ordered_speed_mps = speed_now_mps_;
  state_.length_m = ship.length_m();
  state_.beam_m = ship.beam_m();
  state_.height_m = ship.height_m();
  plan();
}

void OwnShip::order(std::optional<double> course_deg, std::optional<double> speed_mps) {
  if (course_deg) finite(*course_deg, "course", state_.name);
  if (speed_mps) finite(*speed_mps, "speed", state_.name);
  if (course_deg) state_.ordered_course_deg = wrapped_course(*course_deg);
  if (speed_mps) state_.ordered_speed_mps = *speed_mps;
}

double OwnShip::course_error_deg() const {
  const double error = std::remainder(state_.ordered_course_deg - state_.heading_deg, 360.0);
  return error == -180.0 ? 180.0 : error;
}

void OwnShip::plan() {
  state_.course_over_ground_deg = state_.heading_deg;

  const double ordered = state_.ordered_speed_mps;
  const double slack = speed_now_mps_ - ordered;
  state_.speed_mps = ordered + slack * speed_mean_;
  speed_next_mps_ = ordered + slack * speed_decay_;

  const double settling_s = 4.5 * std::max(turn_time_constant_s_, 1.0);
  const double command =
      std::clamp(course_error_deg() / settling_s, -max_rate_deg_s_, max_rate_deg_s_);
  const double lag = rate_now_deg_s_ - command;
  state_.rate_of_turn_deg_s = command + lag * turn_mean_;
  rate_next_deg_s_ = command + lag * turn_decay_;
}

void OwnShip::step() {
  const double half_turn_deg = 0.5 * state_.rate_of_turn_deg_s * tick_s_;
  const double chord_m = state_.speed_mps * tick_s_ * chord_over_arc(half_turn_deg);
  state_.position = rhumb_destination(state_.position, state_.heading_deg + half_turn_deg, chord_m);
  state_.heading_deg = wrapped_course(state_.heading_deg + 2.0 * half_turn_deg);
  speed_now_mps_ = speed_next_mps_;
  rate_now_deg_s_ = rate_next_deg_s_;
  plan();
}

void OwnShip::leap(std::int64_t ticks) {
  const auto on_course = [this] {
    return std::fabs(course_error_deg()) < 1e-6 && std::fabs(rate_now_deg_s_) < 1e-6;
  };
  for (std::int64_t fine = 0; ticks > 0 && fine < kFineTicks && !on_course(); ++fine, --ticks) {
    step();
  }
  if (ticks == 0) return;
  step();  // the tick already planned
  const double rest_s = static_cast<double>(ticks - 1) * tick_s_;
  const double ordered = state_.ordered_speed_mps;
  const double slack = speed_now_mps_ - ordered;
  const double decay = std::expm1(-rest_s / speed_time_constant_s_);
  state_.heading_deg = state_.ordered_course_deg;
  state_.position = rhumb_destination(state_.position, state_.heading_deg,
                                      ordered * rest_s - slack * speed_time_constant_s_ * decay);
  speed_now_mps_ = ordered + slack * (1.0 + decay);
  rate_now_deg_s_ = 0.0;
  plan();
}

}  // namespace skerry::server
