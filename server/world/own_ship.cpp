#include "server/world/own_ship.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/sensors/sensor_reading.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

// Nearer than this the ship is at what was ordered, and stays there: without it, the response would
// creep through ever smaller numbers for ever.  1e-9 deg is 2 mm off in 100 000 km.
constexpr double kSettled = 1e-9;  // deg, deg/s, m/s

}  // namespace

OwnShip::Lag::Lag(double time_constant_s, double tick_s)
    : kept(std::exp(-tick_s / time_constant_s)),
      mean_kept(-std::expm1(-tick_s / time_constant_s) * time_constant_s / tick_s) {}

OwnShip::OwnShip(const scenario::OwnShip& ship, const Environment& environment, Duration tick,
                 std::uint64_t seed)
    : tick_(tick),
      speed_lag_(ship.speed_time_constant_s(), in_seconds(tick)),
      turn_lag_(ship.turn_time_constant_s(), in_seconds(tick)),
      turn_gain_(0.25 / (ship.turn_time_constant_s() + in_seconds(tick))),
      max_rate_deg_s_(ship.max_rate_of_turn_deg_min() / 60.0),
      ordered_course_deg_(wrapped_degrees(ship.course_deg())),
      ordered_speed_mps_(knots_in_mps(ship.speed_kn())),
      speed_mps_(ordered_speed_mps_),
      end_speed_mps_(ordered_speed_mps_) {
  state_.name = ship.name();
  state_.position = geo_point(ship.position());
  state_.heading_deg = ordered_course_deg_;
  state_.course_over_ground_deg = ordered_course_deg_;
  state_.length_m = ship.length_m();
  state_.beam_m = ship.beam_m();
  state_.height_m = ship.height_m();
  state_.wake = ship.wake();
  state_.mmsi = ship.mmsi();
  if (ship.has_ship_class()) {
    const ShipClass& found = *find_ship_class(ship.ship_class());
    const bool isherwood = ship.wind_model() == scenario::OwnShip::isherwood;
    class_ship_.emplace(isherwood ? in_isherwoods_wind(found) : found, ship, seed);
  }
  begin_tick(environment);
}

void OwnShip::order_course(double course_deg) {
  ordered_course_deg_ = wrapped_degrees(course_deg);
  if (class_ship_) class_ship_->order_course(course_deg);
}

void OwnShip::order_speed(double speed_mps) {
  ordered_speed_mps_ = speed_mps;
  if (class_ship_) class_ship_->order_speed(speed_mps);
}

std::optional<std::string> OwnShip::fault_of(const wire::ConOrder& order) const {
  if (class_ship_) return class_ship_->fault_of(order);
  return fmt::format(
      "{} has no ship class, so she has neither wheel nor lever; order course and speed, or give "
      "her a ship_class in the scenario",
      state_.name);
}

void OwnShip::order(const wire::ConOrder& order) { class_ship_->order(order); }

void OwnShip::set_faults(const wire::Faults& faults) {
  if (faults.ByteSizeLong() == 0) {
    state_.faults = nullptr;
    return;
  }
  auto next = std::make_shared<FaultState>(
      FaultState{.faults = faults, .gyro_drifts_since = now_, .gnss_drifts_since = now_});
  if (const FaultState* const was = state_.faults.get()) {
    if (was->faults.gyro_drift_deg_min() == faults.gyro_drift_deg_min()) {
      next->gyro_drifts_since = was->gyro_drifts_since;
    }
    if (was->faults.gnss_drift_kn() == faults.gnss_drift_kn() &&
        was->faults.gnss_drift_deg() == faults.gnss_drift_deg()) {
      next->gnss_drifts_since = was->gnss_drifts_since;
    }
  }
  hold_what_is_lost(state_.faults.get(), *next);
  state_.faults = std::move(next);
}

// What was said last, but for the noise.
void OwnShip::hold_what_is_lost(const FaultState* was, FaultState& next) const {
  const SensorReading lost = reading_of(&next, now_, 0);
  if (!lost.no_heading && !lost.no_position) return;
  FaultState steady = was ? *was : FaultState{};
  steady.faults.clear_gyro_noise_deg();
  steady.faults.clear_gnss_noise_m();
  const SensorReading before = reading_of(&steady, now_, 0);
  if (lost.no_heading) {
    next.held_heading_deg = before.no_heading
                                ? steady.held_heading_deg
                                : wrapped_degrees(state_.heading_deg + before.heading_deg);
  }
  if (lost.no_position) {
    next.held_position =
        before.no_position ? steady.held_position : moved_by(state_.position, before);
  }
}

void OwnShip::step(const Environment& environment) {
  const ShipPlace place = position_at(state_, tick_);
  if (place.over_pole) {
    ordered_course_deg_ = wrapped_degrees(ordered_course_deg_ + 180.0);
    if (class_ship_) class_ship_->reverse_course();
  }
  state_.position = place.position;
  state_.heading_deg = place.heading_deg;
  state_.course_over_ground_deg = place.course_over_ground_deg;
  now_ += tick_;
  if (driven_) {
    if (!driven_->is_over(now_)) return driven_->steer(now_, tick_, state_);
    return end_drive(environment);
  }
  speed_mps_ = end_speed_mps_;
  rate_deg_s_ = end_rate_deg_s_;
  begin_tick(environment);
}

bool OwnShip::drive(const OwnShipFix& fix, Duration now) {
  const bool begins = !driven_;
  if (begins) driven_.emplace(state_, now_);
  if (begins) state_.aground = false;  // whoever drives her says where she is
  driven_->take(fix, now);
  state_.driven = true;
  return begins;
}

void OwnShip::end_drive(const Environment& environment) {
  driven_.reset();
  state_.driven = false;
  go_on(environment);
}

void OwnShip::put(const ShipState& there, const Environment& environment) {
  state_.position = there.position;
  state_.heading_deg = wrapped_degrees(there.heading_deg);
  state_.speed_mps = there.speed_mps;
  state_.rate_of_turn_deg_s = 0.0;
  state_.aground = there.aground;
  if (driven_) return;  // until the next fix
  go_on(environment);
}

void OwnShip::run_aground(const ShipState& there) {
  state_.aground = true;
  state_.position = there.position;
  state_.heading_deg = there.heading_deg;
  lie_still();
  if (class_ship_) class_ship_->lie_still(state_);
}

void OwnShip::lie_still() {
  speed_mps_ = end_speed_mps_ = rate_deg_s_ = end_rate_deg_s_ = commanded_deg_s_ = 0.0;
  state_.course_over_ground_deg = state_.heading_deg;
  state_.speed_mps = state_.rate_of_turn_deg_s = 0.0;
}

void OwnShip::go_on(const Environment& environment) {
  ordered_course_deg_ = state_.course_over_ground_deg = state_.heading_deg;
  ordered_speed_mps_ = speed_mps_ = state_.speed_mps;
  rate_deg_s_ = commanded_deg_s_ =
      std::clamp(state_.rate_of_turn_deg_s, -max_rate_deg_s_, max_rate_deg_s_);
  if (class_ship_) class_ship_->resume(state_);
  begin_tick(environment);
}

void OwnShip::begin_tick(const Environment& environment) {
  if (class_ship_) return class_ship_->begin_tick(environment, now_, tick_, state_);
  state_.ordered_course_deg = ordered_course_deg_;
  state_.ordered_speed_mps = ordered_speed_mps_;
  if (state_.aground) return lie_still();
  const wire::Faults* const faults = state_.faults ? &state_.faults->faults : nullptr;
  const bool steers = !faults || !(faults->steering_lost() || faults->blackout());
  const bool drives = !faults || !(faults->engine_tripped() || faults->blackout());
  const double speed_goal = drives ? ordered_speed_mps_ : 0.0;
  double left_deg = std::remainder(ordered_course_deg_ - state_.heading_deg, 360.0);
  if (left_deg == -180.0) left_deg = 180.0;
  if (steers && std::fabs(left_deg) < kSettled && std::fabs(rate_deg_s_) < kSettled) {
    state_.heading_deg = state_.course_over_ground_deg = ordered_course_deg_;
    left_deg = rate_deg_s_ = 0.0;
  }
  if (std::fabs(speed_mps_ - speed_goal) < kSettled) speed_mps_ = speed_goal;

  if (steers)
    commanded_deg_s_ = std::clamp(turn_gain_ * left_deg, -max_rate_deg_s_, max_rate_deg_s_);
  state_.rate_of_turn_deg_s = turn_lag_.mean(rate_deg_s_, commanded_deg_s_);
  state_.speed_mps = speed_lag_.mean(speed_mps_, speed_goal);
  end_rate_deg_s_ = turn_lag_.end(rate_deg_s_, commanded_deg_s_);
  end_speed_mps_ = speed_lag_.end(speed_mps_, speed_goal);
}

}  // namespace skerry::server
