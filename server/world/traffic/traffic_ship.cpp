#include "server/world/traffic/traffic_ship.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr Duration kLookEvery = std::chrono::seconds(5);
constexpr Duration kStagger = std::chrono::milliseconds(100);
constexpr double kMostSpeed_kn = 100.0;  // as scenario.proto has it
constexpr double kTrawls_kn = 3.0;
constexpr double kSettledTurn = 1e-9;  // deg, deg/s, m/s, as an own ship
constexpr double kDrifts_mps = 0.5;    // with less way she evades nobody
constexpr double kFishingRate = 0.5;   // of what she can turn, with a net out

bool has_traffic_key(const scenario::Target& target) {
  const auto& waypoints = target.waypoints();
  return target.has_ship_class() || target.has_max_rate_of_turn_deg_min() ||
         target.has_gives_way() || target.has_route_end() || target.start_min() > 0.0 ||
         target.anchored() || target.has_follows() || target.fishes_within_nm() > 0.0 ||
         target.along_nm() > 0.0 ||
         std::any_of(waypoints.begin(), waypoints.end(), [](const wire::Waypoint& w) {
           return w.has_speed_kn() || w.has_arrive_min() || w.stop_min() > 0.0;
         });
}

const TrafficClass& class_of(const scenario::Target& target) {
  const TrafficClass* const given = find_traffic_class(target.ship_class());
  return given != nullptr ? *given : traffic_class_of_length(target.length_m());
}

ShipAnswer answer_of(const scenario::Target& target) {
  const TrafficClass& her_class = class_of(target);
  ShipAnswer answer{her_class.turn_s, her_class.speed_s, her_class.most_rate_deg_min / 60.0,
                    knots_in_mps(her_class.service_kn), most_speed_mps(target)};
  if (target.has_max_rate_of_turn_deg_min()) {
    answer.most_rate_deg_s = target.max_rate_of_turn_deg_min() / 60.0;
  }
  return answer;
}

Windage windage_of(const scenario::Target& target) {
  const TrafficClass& her_class = class_of(target);
  return {target.length_m(), target.height_m(), her_class.draught_m};
}

// Its legs would take much memory, and nobody sails them.
scenario::Target without_way(const scenario::Target& target) {
  scenario::Target still = target;
  still.clear_waypoints();
  still.set_speed_kn(0.0);
  return still;
}

Privilege privilege_of(const scenario::Target& target) {
  if (target.fishes_within_nm() > 0.0) return Privilege::fishing;
  return target.ship_type() == scenario::sailing ? Privilege::sail : Privilege::power;
}

}  // namespace

double most_speed_mps(const scenario::Target& target) {
  const TrafficClass* const given = find_traffic_class(target.ship_class());
  return knots_in_mps(given != nullptr ? given->most_kn : kMostSpeed_kn);
}

TrafficShip::TrafficShip(const scenario::Target& target, std::size_t number, std::uint64_t seed,
                         std::optional<Leader> leader, Duration begin,
                         const Environment& environment)
    : target_(std::make_shared<const scenario::Target>(target)),
      track_(
          std::make_shared<const TargetTrack>(target.as_logged() ? without_way(target) : target)),
      number_(number),
      begin_(begin),
      answer_(answer_of(target)),
      gives_way_(static_cast<wire::GiveWay>(target.gives_way())),
      start_s_(std::max(60.0 * target.start_min(), in_seconds(begin))),
      course_deg_(wrapped_degrees(target.course_deg())),
      speed_mps_(knots_in_mps(target.speed_kn())),
      leader_(leader) {
  state_ = track_->at(Duration::zero());
  state_.number = number;
  if (target.has_radar()) {
    state_.radar = std::make_shared<const echo::RadarSet>(*shipped_set(target.radar()));
  }
  if (target.as_logged()) {
    way_ = Way::log;
    log_ = std::make_shared<const LoggedTrack>(target);
  }
  if (way_ == Way::log || !has_traffic_key(target)) return;
  const GeoPoint place = geo_point(target.position());
  if (target.anchored()) {
    way_ = Way::anchor;
    swing_.emplace(place, target.swing_radius_m(), target.course_deg(), windage_of(target), seed);
    swing_->settle(environment, in_seconds(begin));
    speed_mps_ = 0.0;
    state_.position = swing_->place(in_seconds(begin));
    state_.heading_deg = wrapped_degrees(swing_->bearing_deg(in_seconds(begin)) + 180.0);
  } else if (leader_) {
    way_ = Way::station;
    station_ = {target.follow_bearing_deg(),
                nautical_miles(target.follow_distance_nm()).in_metres()};
  } else if (target.fishes_within_nm() > 0.0) {
    way_ = Way::fishing;
    fishing_.emplace(place, nautical_miles(target.fishes_within_nm()).in_metres(), seed);
    speed_mps_ = knots_in_mps(kTrawls_kn);
  } else if (target.waypoints_size() > 0) {
    way_ = Way::route;
    route_.emplace(route_of(place, start_s_, speed_mps_, target.waypoints(),
                            static_cast<wire::RouteEnd>(target.route_end())),
                   start_s_, nautical_miles(target.along_nm()).in_metres());
    state_.position = route_->place();
    state_.heading_deg = route_->course_deg();
    speed_mps_ = std::min(route_->speed_mps(), answer_.most_mps);
  } else {
    way_ = Way::course;
  }
  end_.speed_mps = start_s_ > in_seconds(begin) || way_ == Way::anchor ? 0.0 : speed_mps_;
  state_.speed_mps = state_.ordered_speed_mps = end_.speed_mps;
  state_.course_over_ground_deg = state_.ordered_course_deg = state_.heading_deg;
}

bool TrafficShip::is_on_water(Duration now) const {
  return !removed_ && (way_ != Way::log || log_->covers(now));
}

ShipState TrafficShip::plotted(Duration now) const {
  if (way_ == Way::track) return track_->at(now - begin_);
  ShipState ship = state_;
  log_->put(now, ship);
  return ship;
}

std::size_t TrafficShip::passed_at(Duration now) const {
  return way_ == Way::track ? track_->passed_at(now - begin_) : log_->passed_at(now);
}

ShipState TrafficShip::state(Duration now, Duration reached) const {
  if (is_plotted()) {
    ShipState ship = plotted(now);
    ship.number = number_;
    ship.radar = state_.radar;
    ship.sart = state_.sart;
    ship.ais_off = state_.ais_off;
    ship.ais_heading_error_deg = state_.ais_heading_error_deg;
    ship.ais_position_error_m = state_.ais_position_error_m;
    return ship;
  }
  ShipState ship = state_;
  if (now == reached) return ship;
  const ShipPlace place = position_at(ship, now - reached);
  ship.position = place.position;
  ship.heading_deg = place.heading_deg;
  ship.course_over_ground_deg = place.course_over_ground_deg;
  return ship;
}

void TrafficShip::advance(Duration tick) {
  if (is_plotted() || removed_) return;
  const ShipPlace place = position_at(state_, tick);
  state_.position = place.position;
  state_.heading_deg = place.heading_deg;
  state_.course_over_ground_deg = place.course_over_ground_deg;
  if (!place.over_pole) return;
  course_deg_ = wrapped_degrees(course_deg_ + 180.0);
  if (ordered_course_deg_) ordered_course_deg_ = wrapped_degrees(*ordered_course_deg_ + 180.0);
}

bool TrafficShip::looks(Duration now, Duration tick) const {
  if (is_plotted() || removed_ || gives_way_ == wire::GIVE_WAY_NEVER) return false;
  if (way_ == Way::anchor && !is_off_route()) return false;
  const Duration mine = kStagger * static_cast<std::int64_t>(number_ % 50);
  return (now + mine) / kLookEvery != (now + mine - tick) / kLookEvery;
}

std::optional<Leader> TrafficShip::follows() const {
  return way_ == Way::station && !removed_ ? leader_ : std::nullopt;
}

RouteOrder TrafficShip::wish(Duration now, const ShipState* leader, Wanted& wanted) {
  const double now_s = in_seconds(now);
  RouteOrder wish;
  wish.course_deg = course_deg_;
  wish.speed_mps = speed_mps_;
  switch (way_) {
    case Way::route:
      wish = route_->steer(state_.position, state_.heading_deg, end_.speed_mps, now_s, answer_);
      return wish;
    case Way::station:
      if (leader != nullptr) {
        const StationOrder order = keep_station(station_, *leader, state_, answer_);
        wish.course_deg = course_deg_ = order.course_deg;
        wish.speed_mps = speed_mps_ = order.speed_mps;
      }
      break;
    case Way::fishing: {
      wanted.share_of_rate = kFishingRate;
      const double rate = kFishingRate * answer_.rate_limit_deg_s(end_.speed_mps);
      const double circle_m = 2.0 * end_.speed_mps / (rate * kRadiansPerDegree);
      const FishingOrder order = fishing_->steer(state_.position, now_s, circle_m);
      wish.course_deg = order.course_deg;
      wish.speed_mps = order.speed_mps;
      break;
    }
    default:
      break;
  }
  wish.leg_deg = wish.course_deg;
  return wish;
}

void TrafficShip::plan(Duration now, Duration tick, const Environment& environment,
                       std::span<const SeenShip> others, const ShipState* leader) {
  const bool looks_round = looks(now, tick);
  if (is_plotted() || removed_) return;
  if (way_ == Way::anchor && !is_off_route()) return lie_at_anchor(now, tick, environment);
  const bool lies = in_seconds(now) < start_s_ && !is_off_route();
  Wanted wanted;
  RouteOrder order;
  if (lies) {
    order.course_deg = order.leg_deg = state_.heading_deg;
  } else if (is_off_route() && (way_ != Way::route || ordered_course_deg_)) {
    order.course_deg = order.leg_deg = course_deg_;
    order.speed_mps = way_ == Way::course ? speed_mps_ : end_.speed_mps;
  } else {
    order = wish(now, leader, wanted);
  }
  if (order.vanishes) {
    removed_ = true;
    return;
  }
  if (order.put) {
    state_.position = *order.put;
    state_.heading_deg = order.course_deg;
    end_ = {order.speed_mps, 0.0};
    evasion_.reset();
  }
  if (ordered_course_deg_) order.course_deg = order.leg_deg = *ordered_course_deg_;
  if (ordered_speed_mps_ && !lies) {
    order.speed_mps = *ordered_speed_mps_;
    if (ordered_course_deg_) order.brake_mps2 = 0.0;
  }
  const Visibility visibility{nautical_miles(environment.visibility_nm).in_metres()};
  if (gives_way_ != wire::GIVE_WAY_NEVER && !ordered_speed_mps_ && way_ != Way::station) {
    order.speed_mps = safe_speed_mps(order.speed_mps, visibility);
  }
  if (!lies) evade(looks_round, others, visibility, order);

  wanted.left_deg = std::remainder(order.course_deg - state_.heading_deg, 360.0);
  if (wanted.left_deg == -180.0) wanted.left_deg = 180.0;
  wanted.speed_mps = order.speed_mps;
  wanted.brake_mps2 = order.brake_mps2;
  if (std::fabs(wanted.left_deg) < kSettledTurn && std::fabs(end_.rate_deg_s) < kSettledTurn) {
    state_.heading_deg = wrapped_degrees(order.course_deg);
    wanted.left_deg = end_.rate_deg_s = 0.0;
  }
  if (std::fabs(end_.speed_mps - wanted.speed_mps) < kSettledTurn && wanted.brake_mps2 == 0.0) {
    end_.speed_mps = wanted.speed_mps;
  }
  if (lies) end_ = {};
  const TickMotion motion =
      lies ? TickMotion{} : tick_motion(answer_, end_, wanted, in_seconds(tick));
  end_ = motion.end;
  state_.course_over_ground_deg = state_.heading_deg;
  state_.speed_mps = motion.mean.speed_mps;
  state_.rate_of_turn_deg_s = motion.mean.rate_deg_s;
  state_.ordered_course_deg = wrapped_degrees(order.course_deg);
  state_.ordered_speed_mps = order.brake_mps2 > 0.0 ? 0.0 : order.speed_mps;
}

void TrafficShip::evade(bool looks_round, std::span<const SeenShip> others,
                        const Visibility& visibility, RouteOrder& order) {
  if (gives_way_ == wire::GIVE_WAY_NEVER) {
    evasion_.reset();
    return;
  }
  if (looks_round) {
    // Alone she would sail as ordered; but while she does not evade, what she makes counts.
    const double alone_mps = evasion_ ? order.speed_mps : end_.speed_mps;
    evasion_ = alone_mps < kDrifts_mps ? std::nullopt
                                       : look_round(seen({}), order.leg_deg, alone_mps, gives_way_,
                                                    evasion_, others, visibility);
  }
  if (!evasion_) return;
  order.course_deg = wrapped_degrees(order.leg_deg + evasion_->alteration_deg);
  order.speed_mps *= evasion_->share_of_speed;
}

void TrafficShip::lie_at_anchor(Duration now, Duration tick, const Environment& environment) {
  const double now_s = in_seconds(now), tick_s = in_seconds(tick);
  swing_->step(environment, now_s, tick_s);
  const double next_deg = swing_->bearing_deg(now_s + tick_s) + 180.0;
  const double turn_deg = std::remainder(next_deg - state_.heading_deg, 360.0);
  const ShortWay way = short_way_between(state_.position, swing_->place(now_s + tick_s));
  const double length_m = std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
  state_.rate_of_turn_deg_s = turn_deg / tick_s;
  state_.speed_mps = length_m / (tick_s * chord_of_arc(turn_deg));
  // position_at() turns the course by half of the turn before the middle of the tick.
  if (length_m > 1e-9) {
    state_.course_over_ground_deg = wrapped_degrees(
        echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian - 0.5 * turn_deg);
  } else {
    state_.speed_mps = 0.0;
  }
  state_.ordered_course_deg = state_.heading_deg;
  state_.ordered_speed_mps = 0.0;
  end_ = {};
}

SeenShip TrafficShip::seen(Duration now) const {
  const ShipState ship = is_plotted() ? plotted(now) : ShipState{};
  const ShipState& here = is_plotted() ? ship : state_;
  const echo::SinCos course = echo::sin_cos_degrees(here.course_over_ground_deg);
  const double speed = is_plotted() ? here.speed_mps : end_.speed_mps;
  SeenShip seen;
  seen.number = number_;
  seen.position = here.position;
  seen.way = {speed * course.sin, speed * course.cos};
  seen.course_deg = here.course_over_ground_deg;
  seen.speed_mps = speed;
  seen.length_m = here.length_m;
  seen.privilege = way_ == Way::anchor ? Privilege::power : privilege_of(*target_);
  return seen;
}

}  // namespace skerry::server
