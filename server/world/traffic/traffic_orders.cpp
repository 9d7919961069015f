// Orders to a ship of the traffic, and what is told of her.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/traffic/traffic_ship.hpp"
#include "server/world/traffic/way_faults.hpp"

namespace skerry::server {
namespace {

bool moves_her(const wire::TargetChange& change) {
  return change.has_course_deg() || change.has_speed_kn() || change.route_size() > 0 ||
         change.has_route_end() || change.has_gives_way() || change.has_latitude_deg();
}

}  // namespace

std::optional<std::string> TrafficShip::fault_of(const wire::TargetChange& change,
                                                 Duration now) const {
  const std::string who = target_->has_ship_class()
                              ? fmt::format("{}, a {},", target_->name(), target_->ship_class())
                              : target_->name();
  if (way_ == Way::log && !log_->covers(now) && moves_her(change)) {
    return fmt::format(
        "{} sails as a log has her, and is not on the water at {:.1f} min; allowed: "
        "orders while she is",
        target_->name(), in_seconds(now) / 60.0);
  }
  if (change.has_latitude_deg() != change.has_longitude_deg()) {
    return "latitude and longitude: one is given without the other; expected both or none";
  }
  if (change.has_speed_kn()) {
    if (auto fault = fault_of_speed(who, change.speed_kn(), answer_.most_mps)) return fault;
  }
  if (change.route_size() == 0) return std::nullopt;
  const GeoPoint from =
      change.has_latitude_deg()
          ? GeoPoint{change.latitude_deg(), wrapped_longitude(change.longitude_deg())}
          : state(now, now).position;
  return fault_of_way(who, from, change.route(), answer_.most_mps);
}

void TrafficShip::become_stepped(Duration now) {
  if (!is_plotted()) return;
  const ShipState here = state(now, now);
  const std::size_t passed = passed_at(now);
  const wire::RouteEnd end = way_ == Way::log ? wire::END_VANISH : wire::END_STOP;
  state_ = here;
  end_ = {here.speed_mps, 0.0};
  course_deg_ = here.heading_deg;
  speed_mps_ = here.speed_mps;
  way_ = Way::course;
  if (passed >= static_cast<std::size_t>(target_->waypoints_size())) return;
  auto left = target_->waypoints();
  left.DeleteSubrange(0, static_cast<int>(passed));
  const double now_s = in_seconds(now);
  way_ = Way::route;
  route_.emplace(route_of(here.position, now_s, here.speed_mps, left, end), now_s);
}

void TrafficShip::take_route(const wire::TargetChange& change, Duration now) {
  const double now_s = in_seconds(now);
  double speed_mps = std::max(speed_mps_, end_.speed_mps);
  if (change.has_speed_kn() && change.speed_kn() > 0.0) {
    speed_mps = knots_in_mps(change.speed_kn());
  } else if (speed_mps < 0.5) {
    speed_mps = std::min(answer_.service_mps, answer_.most_mps);
  }
  const wire::RouteEnd end = change.has_route_end() ? change.route_end()
                             : route_               ? route_->route().end
                                                    : wire::END_STOP;
  way_ = Way::route;
  start_s_ = now_s;
  speed_mps_ = speed_mps;
  route_.emplace(route_of(state_.position, now_s, speed_mps, change.route(), end), now_s);
  ordered_course_deg_.reset();
  ordered_speed_mps_.reset();
}

void TrafficShip::order(const wire::TargetChange& change, Duration now) {
  if (moves_her(change)) become_stepped(now);
  if (change.has_latitude_deg()) {
    state_.position = {change.latitude_deg(), wrapped_longitude(change.longitude_deg())};
    evasion_.reset();
    if (route_) route_->leave_from(state_.position);
    if (swing_) swing_->drop_anchor(state_.position, state_.heading_deg);
    if (fishing_) fishing_->work_round(state_.position);
  }
  if (change.has_gives_way()) gives_way_ = change.gives_way();
  if (change.has_route_end() && route_) route_->end_with(change.route_end());
  if (change.resume()) {
    if (ordered_course_deg_ && route_) route_->leave_from(state_.position);
    if (ordered_course_deg_ && swing_) swing_->drop_anchor(state_.position, state_.heading_deg);
    ordered_course_deg_.reset();
    ordered_speed_mps_.reset();
  }
  if (change.route_size() > 0) {
    take_route(change, now);
  } else {
    if (change.has_speed_kn()) ordered_speed_mps_ = knots_in_mps(change.speed_kn());
  }
  if (change.has_course_deg()) ordered_course_deg_ = wrapped_degrees(change.course_deg());
  if (change.has_removed()) removed_ = change.removed();
  if (change.has_sart()) state_.sart = change.sart();
  if (change.has_ais_off()) state_.ais_off = change.ais_off();
  if (change.has_ais_heading_error_deg()) {
    state_.ais_heading_error_deg = change.ais_heading_error_deg();
  }
  if (change.has_ais_position_error_m()) {
    state_.ais_position_error_m = change.ais_position_error_m();
  }
}

void TrafficShip::tell(Duration now, wire::ExerciseShip& ship) const {
  const ShipState here = state(now, now);
  ship.set_number(static_cast<std::uint32_t>(number_));
  ship.set_name(target_->name());
  ship.set_ship_class(target_->ship_class());
  ship.set_mmsi(target_->mmsi());
  ship.set_length_m(here.length_m);
  ship.set_beam_m(here.beam_m);
  const bool gone = !is_on_water(now);
  if (gone) {
    ship.set_latitude_deg(here.position.latitude_deg);
    ship.set_longitude_deg(here.position.longitude_deg);
    ship.set_heading_deg(here.heading_deg);
  }
  ship.set_gives_way(gives_way_);
  ship.set_gives_way_now(evasion_.has_value());
  ship.set_removed(gone);
  ship.set_sart(here.sart);
  ship.set_ais_off(here.ais_off);
  ship.set_on_course(is_off_route());
  if (route_) {
    for (wire::Waypoint& waypoint : route_->left()) *ship.add_route() = std::move(waypoint);
    ship.set_route_end(route_->route().end);
  } else if (is_plotted()) {
    const std::size_t passed = passed_at(now);
    for (int i = static_cast<int>(passed); i < target_->waypoints_size(); ++i) {
      *ship.add_route() = target_->waypoints(i);
    }
  }
}

}  // namespace skerry::server
