#include "server/world/class_ship.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/bank_effect.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/handling/machinery.hpp"
#include "server/world/sensors/sensor_reading.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

double wave_height_of(double sea_state) {
  constexpr std::array<double, 7> kHeights = {0.0, 0.05, 0.3, 0.88, 1.88, 3.25, 5.0};
  const double state = std::clamp(sea_state, 0.0, 6.0);
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(state), 5);
  const double share = state - static_cast<double>(below);
  return kHeights[below] + share * (kHeights[below + 1] - kHeights[below]);
}

double wind_of(double sea_state) {
  if (sea_state <= 0.0) return 0.0;
  return 3.16 * echo::exact_exp2(0.8 * echo::exact_log2(sea_state));
}

Machinery machinery_of(const FaultState* state) {
  if (state == nullptr) return {};
  const wire::Faults& faults = state->faults;
  const bool dark = faults.blackout();
  return {.steering_lost = faults.steering_lost() || dark,
          .steering_one_pump = faults.steering_one_pump(),
          .engine_tripped = faults.engine_tripped() || dark,
          .thrusters_lost = faults.thrusters_lost() || dark};
}

}  // namespace

Surroundings surroundings_of(const Environment& environment, GeoPoint at, Duration since_start,
                             std::uint64_t seed) {
  const echo::SeaSurface& sea = environment.sea;
  Surroundings around;
  around.wind_from_deg = sea.wind_from_deg;
  around.wind_mps = environment.wind_kn ? knots_in_mps(*environment.wind_kn) : wind_of(sea.state);
  const CurrentHere current = current_at(environment, at, since_start);
  around.current_set_deg = current.set_deg;
  around.current_mps = current.mps;
  around.depth_m = environment.depth_m + environment.waters->over_depth_m(since_start);
  const double wind_waves = wave_height_of(sea.state);
  const bool swell = sea.swell.height_m > wind_waves;
  around.wave_height_m = swell ? sea.swell.height_m : wind_waves;
  around.waves_from_deg = swell ? sea.swell.from_deg : sea.wind_from_deg;
  around.time_s = in_seconds(since_start);
  around.seed = seed;
  return around;
}

ClassShip::ClassShip(const ShipClass& ship, const scenario::OwnShip& scenario, std::uint64_t seed,
                     int steps_per_tick)
    : class_(ship), seed_(seed), steps_per_tick_(steps_per_tick) {
  const double speed = std::clamp(knots_in_mps(scenario.speed_kn()), -0.5 * ship.service_speed_mps,
                                  1.2 * ship.service_speed_mps);
  state_ = under_way(ship, wrapped_degrees(scenario.course_deg()), speed);
  helm_.steering = SteeringMode::heading;
  helm_.heading_deg = wrapped_degrees(scenario.course_deg());
  helm_.keeps_speed = true;
  helm_.speed_mps = speed;
  helm_.turn_radius_m = scenario.turn_radius_nm() * 1852.0;
  leg_from_ = geo_point(scenario.position());
  for (const scenario::Position& point : scenario.route()) route_.push_back(geo_point(point));
  if (!route_.empty()) helm_.steering = SteeringMode::track;
}

std::optional<std::string> ClassShip::fault_of(const wire::ConOrder& order) const {
  if (order.has_bow_thruster_percent() && class_.bow.force_n == 0.0) {
    return fmt::format("bow thruster: a {} has none", class_.key);
  }
  if (order.has_stern_thruster_percent() && class_.stern.force_n == 0.0) {
    return fmt::format("stern thruster: a {} has none", class_.key);
  }
  if (order.has_rudder_deg() &&
      (order.has_heading_deg() ||
       (order.has_steering() && order.steering() != wire::STEERING_HAND))) {
    return "rudder: given together with an order to the autopilot; expected one of the two";
  }
  if (order.has_steering() && order.steering() == wire::STEERING_TRACK) {
    if (route_.empty()) return "steering: she has no route; give her one in the scenario";
    if (leg_ >= route_.size()) return "steering: she has come to the end of her route";
  }
  return std::nullopt;
}

void ClassShip::order(const wire::ConOrder& order) {
  if (order.has_steering()) {
    helm_.steering = static_cast<SteeringMode>(order.steering());
    helmsman_.reset();
    if (!order.has_heading_deg()) {
      helm_.heading_deg = wrapped_degrees(state_.heading_rad * kDegreesPerRadian);
    }
    if (helm_.steering == SteeringMode::hand && !order.has_rudder_deg()) {
      helm_.wheel_deg = state_.rudder_deg;
    }
  }
  if (order.has_rudder_deg()) {
    helm_.steering = SteeringMode::hand;
    helm_.wheel_deg = std::clamp(order.rudder_deg(), -class_.gear.limit_deg, class_.gear.limit_deg);
  }
  if (order.has_heading_deg()) order_course(order.heading_deg());
  if (order.has_engine_percent()) {
    helm_.keeps_speed = false;
    helm_.lever = order.engine_percent() / 100.0;
  }
  if (order.has_bow_thruster_percent()) helm_.bow = order.bow_thruster_percent() / 100.0;
  if (order.has_stern_thruster_percent()) helm_.stern = order.stern_thruster_percent() / 100.0;
  if (order.has_turn_rate_deg_min()) helm_.most_rate_deg_s = order.turn_rate_deg_min() / 60.0;
}

void ClassShip::order_course(double course_deg) {
  if (helm_.steering != SteeringMode::heading) helmsman_.reset();
  helm_.steering = SteeringMode::heading;
  helm_.heading_deg = wrapped_degrees(course_deg);
}

void ClassShip::order_speed(double speed_mps) {
  helm_.keeps_speed = true;
  helm_.speed_mps = speed_mps;
}

void ClassShip::reverse_course() { helm_.heading_deg = wrapped_degrees(helm_.heading_deg + 180.0); }

void ClassShip::resume(const ShipState& ship) {
  state_ = under_way(
      class_, ship.heading_deg,
      std::clamp(ship.speed_mps, -class_.service_speed_mps, 1.2 * class_.service_speed_mps));
  helmsman_.reset();
  helm_ = {};
  helm_.steering = SteeringMode::heading;
  helm_.heading_deg = ship.heading_deg;
  helm_.keeps_speed = true;
  helm_.speed_mps = state_.motion.u;
}

void ClassShip::lie_still(ShipState& ship) {
  state_.motion = {};
  state_.heading_rad = ship.heading_deg * kRadiansPerDegree;
  ground_ = {};
  ship.speed_mps = ship.rate_of_turn_deg_s = 0.0;
  ship.course_over_ground_deg = ship.heading_deg;
  if (ship.con) ship.con->motion = {};
}

TrackView ClassShip::track_from(GeoPoint position) {
  const auto seen = [&](GeoPoint place) {
    const ShortWay way = short_way_between(position, place);
    return RoutePoint{way.north_m, way.east_m};
  };
  TrackView track{seen(leg_from_), seen(route_[leg_])};
  if (leg_ + 1 < route_.size()) {
    track.has_next = true;
    track.next = seen(route_[leg_ + 1]);
  }
  const double north = track.to.north_m - track.from.north_m;
  const double east = track.to.east_m - track.from.east_m;
  const double length = std::max(std::sqrt(north * north + east * east), 1e-6);
  cross_track_m_ = (track.from.north_m * east - track.from.east_m * north) / length;
  left_m_ = std::sqrt(track.to.north_m * track.to.north_m + track.to.east_m * track.to.east_m);
  return track;
}

void ClassShip::begin_tick(const Environment& environment, Duration now, Duration tick,
                           ShipState& ship) {
  // The heading is that to which position_at() has brought her: what the world shows.
  state_.heading_rad = ship.heading_deg * kRadiansPerDegree;
  Surroundings around = surroundings_of(environment, ship.position, now, seed_);
  if (environment.banks) {
    around.banks = pull_of(*environment.banks, class_.bank_shape(), ship.position, ship.heading_deg,
                           around.depth_m);
  }
  const double tick_s = in_seconds(tick);

  // The autopilot steers by what the gyro says.
  DynamicState told = state_;
  if (ship.faults) {
    told.heading_rad += reading_of(ship.faults.get(), now, seed_).heading_deg * kRadiansPerDegree;
  }
  bool over = false;
  if (helm_.steering == SteeringMode::track) {
    const TrackView track = track_from(ship.position);
    conn_ = helmsman_.orders(class_, told, helm_, ground_, &track, tick_s, over);
    if (over) {
      leg_from_ = route_[leg_++];
      if (leg_ == route_.size()) {
        const double course = echo::exact_atan2(track.to.east_m - track.from.east_m,
                                                track.to.north_m - track.from.north_m);
        order_course(course * kDegreesPerRadian);
      }
    }
  } else {
    conn_ = helmsman_.orders(class_, told, helm_, ground_, nullptr, tick_s, over);
  }
  tell(around, ship);

  const ActuatorOrders acts = acting(machinery_of(ship.faults.get()), conn_);
  const double before_rad = state_.heading_rad;
  WayMade way;
  for (int i = 0; i < steps_per_tick_; ++i) {
    const WayMade part = advance(class_, acts, around, tick_s / steps_per_tick_, state_);
    way.north_m += part.north_m;
    way.east_m += part.east_m;
    around.time_s += tick_s / steps_per_tick_;
  }
  ground_ = {way.north_m / tick_s, way.east_m / tick_s};
  ship.ordered_course_deg = helm_.heading_deg;
  ship.ordered_speed_mps = helm_.keeps_speed ? helm_.speed_mps : state_.motion.u;
  if (ship.aground) return lie_still(ship);

  // As position_at() will have it: along the chord of an arc, on the mean of the course.
  const double turn_deg = (state_.heading_rad - before_rad) * kDegreesPerRadian;
  const double length = std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
  ship.rate_of_turn_deg_s = turn_deg / tick_s;
  ship.speed_mps = length / (tick_s * chord_of_arc(turn_deg));
  const double mean_deg = length > 0.0
                              ? echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian
                              : ship.heading_deg;
  ship.course_over_ground_deg = wrapped_degrees(mean_deg - 0.5 * turn_deg);
}

void ClassShip::tell(const Surroundings& around, ShipState& ship) const {
  ConState& con = ship.con.emplace();
  con.ship_class = &class_;
  con.steering = helm_.steering;
  con.motion = state_.motion;
  con.rudder_deg = state_.rudder_deg;
  con.rudder_order_deg = conn_.rudder_deg;
  con.shaft_rps = state_.shaft_rps;
  const double full = conn_.shaft_rps < 0.0 ? class_.astern_rps : class_.ahead_rps;
  con.engine_percent = helm_.keeps_speed ? 100.0 * conn_.shaft_rps / full : 100.0 * helm_.lever;
  con.keeps_speed = helm_.keeps_speed;
  con.bow_percent = 100.0 * helm_.bow;
  con.stern_percent = 100.0 * helm_.stern;
  con.heading_order_deg = helm_.heading_deg;
  con.turn_rate_deg_min = 60.0 * helm_.most_rate_deg_s;
  con.depth_below_keel_m = around.depth_m - class_.hull->draught_m();
  con.wind_from_deg = around.wind_from_deg;
  con.wind_mps = around.wind_mps;
  con.current_set_deg = around.current_set_deg;
  con.current_mps = around.current_mps;
  con.waypoints = static_cast<std::uint32_t>(route_.size());
  if (helm_.steering == SteeringMode::track) {
    con.waypoint = static_cast<std::uint32_t>(leg_ + 1);
    con.waypoint_m = left_m_;
    con.cross_track_m = cross_track_m_;
  }
}

}  // namespace skerry::server
