#include "server/world/driven_motion.hpp"

#include <GeographicLib/Rhumb.hpp>
#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/rhumb_step.hpp"

namespace skerry::server {
namespace {

constexpr double kAtRest_mps = 0.005;
// Time constant of worked-out motion: sets a new value's share when it comes a second after the
// last.
constexpr double kMemory_s = 1.0;
constexpr double kShortest_s = 0.02;

// Metres east and north.
struct Way {
  double east = 0.0, north = 0.0;
  double length() const { return std::hypot(east, north); }
  double course_deg() const { return wrapped_degrees(std::atan2(east, north) * kDegreesPerRadian); }
};

Way way_between(GeoPoint from, GeoPoint to) {
  double length = 0.0, course = 0.0;
  GeographicLib::Rhumb::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg,
                                        to.longitude_deg, length, course);
  if (!std::isfinite(course)) course = 0.0;  // at a pole, or no way at all
  return {length * std::sin(course / kDegreesPerRadian),
          length * std::cos(course / kDegreesPerRadian)};
}

Way velocity_of(const ShipState& ship) {
  const double course = ship.course_over_ground_deg / kDegreesPerRadian;
  return {ship.speed_mps * std::sin(course), ship.speed_mps * std::cos(course)};
}

bool is_known(const std::optional<Duration>& time, Duration now) {
  return time && now - *time < DrivenMotion::kForget;
}

}  // namespace

ShipState DrivenMotion::reference_at(Duration now) const {
  ShipState ship = reference_;
  const ShipPlace place = position_at(reference_, now - time_);
  ship.position = place.position;
  ship.heading_deg = place.heading_deg;
  ship.course_over_ground_deg = place.course_over_ground_deg;
  return ship;
}

void DrivenMotion::take(const OwnShipFix& fix, Duration now) {
  reference_ = reference_at(now);
  time_ = last_fix_ = now;
  if (fix.course_over_ground_deg) {
    reference_.course_over_ground_deg = wrapped_degrees(*fix.course_over_ground_deg);
  }
  if (fix.speed_mps) {
    // Along the course over ground; what the ship's own motion had was along her heading.
    if (reference_.speed_mps < 0.0 && !fix.course_over_ground_deg) {
      reference_.course_over_ground_deg =
          wrapped_degrees(reference_.course_over_ground_deg + 180.0);
    }
    reference_.speed_mps = *fix.speed_mps;
    velocity_time_ = now;
  }
  if (fix.rate_of_turn_deg_min) {
    reference_.rate_of_turn_deg_s = *fix.rate_of_turn_deg_min / 60.0;
    turn_time_ = now;
  }
  if (fix.position) take_position(*fix.position, now);
  if (fix.heading_deg) take_heading(*fix.heading_deg, now);
}

void DrivenMotion::take_position(GeoPoint position, Duration now) {
  if (!is_known(velocity_time_, now)) {
    const Way off = way_between(reference_.position, position);
    Way velocity = velocity_of(reference_);
    if (!position_time_ || off.length() > kJump_m) {
      velocity = {};
    } else {
      const double since_s = std::max(kShortest_s, in_seconds(now - *position_time_));
      const double share = 1.0 / (since_s + kMemory_s);
      velocity = {velocity.east + share * off.east, velocity.north + share * off.north};
    }
    reference_.speed_mps = velocity.length();
    if (reference_.speed_mps > kAtRest_mps) {
      reference_.course_over_ground_deg = velocity.course_deg();
    }
  }
  reference_.position = position;
  position_time_ = now;
}

void DrivenMotion::take_heading(double heading_deg, Duration now) {
  if (!is_known(turn_time_, now)) {
    const double off = std::remainder(heading_deg - reference_.heading_deg, 360.0);
    if (!heading_time_ || std::fabs(off) > kHeadingJump_deg) {
      reference_.rate_of_turn_deg_s = 0.0;
    } else {
      const double since_s = std::max(kShortest_s, in_seconds(now - *heading_time_));
      reference_.rate_of_turn_deg_s += off / (since_s + kMemory_s);
    }
  }
  reference_.heading_deg = wrapped_degrees(heading_deg);
  heading_time_ = now;
}

void DrivenMotion::steer(Duration now, Duration tick, ShipState& ship) const {
  const double tick_s = in_seconds(tick);
  const double kept = std::exp(-tick_s / kCatchUp_s);
  const ShipState here = reference_at(now);
  const ShipState there = reference_at(now + tick);

  double turn_off = std::remainder(here.heading_deg - ship.heading_deg, 360.0);
  if (std::fabs(turn_off) > kHeadingJump_deg) {
    ship.heading_deg = here.heading_deg;
    turn_off = 0.0;
  }
  ship.rate_of_turn_deg_s = here.rate_of_turn_deg_s + turn_off * (1.0 - kept) / tick_s;

  Way behind = way_between(ship.position, here.position);
  if (behind.length() > kJump_m) {
    ship.position = here.position;
    behind = {};
  }
  const Way to_there = way_between(ship.position, there.position);
  const Way way{to_there.east - kept * behind.east, to_there.north - kept * behind.north};
  if (way.length() < kAtRest_mps * tick_s) {
    ship.speed_mps = 0.0;
    ship.course_over_ground_deg = here.course_over_ground_deg;
  } else {
    // position_at() turns the course by the rate of turn: half of it before the middle of the tick.
    const double half_turn = 0.5 * ship.rate_of_turn_deg_s * tick_s;
    ship.course_over_ground_deg = wrapped_degrees(way.course_deg() - half_turn);
    ship.speed_mps = way.length() / (tick_s * chord_of_arc(2.0 * half_turn));
  }
  ship.ordered_course_deg = here.heading_deg;
  ship.ordered_speed_mps = here.speed_mps;
}

}  // namespace skerry::server
