#include "server/world/handling/helmsman.hpp"

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr double kUsualRadius = 4.0;     // of a turn, in lengths
constexpr double kSlowestWay_mps = 1.0;  // below it gains are those of this

double turned_within(double radians) { return std::remainder(radians, kRadiansPerTurn); }

double gain_speed(const DynamicState& state) {
  return std::max(std::fabs(state.motion.u), kSlowestWay_mps);
}

// Bearing of a point from the ship, rad.
double bearing_to(RoutePoint p) { return echo::exact_atan2(p.east_m, p.north_m); }

// The course along a leg that brings her on it, and what is left to its end.
struct LegView {
  double course_rad = 0.0;  // of the leg
  double left_m = 0.0;      // along it to its end
  double off_m = 0.0;       // she is to starboard of it
};

LegView view_of(RoutePoint from, RoutePoint to) {
  const double north = to.north_m - from.north_m, east = to.east_m - from.east_m;
  const double length = std::sqrt(squared(north) + squared(east));
  if (length < 1e-6) return {bearing_to(to), std::sqrt(squared(to.north_m) + squared(to.east_m))};
  LegView leg;
  leg.course_rad = echo::exact_atan2(east, north);
  leg.left_m = (to.north_m * north + to.east_m * east) / length;
  leg.off_m = (from.north_m * east - from.east_m * north) / length;
  return leg;
}

}  // namespace

double usual_rate_deg_s(const ShipClass& ship, double speed_mps) {
  return std::fabs(speed_mps) / (kUsualRadius * ship.hull->length_m()) * kDegreesPerRadian;
}

double Helmsman::rudder_for(const ShipClass& ship, const DynamicState& state, double left_rad,
                            double most_rate_rad, double tick_s) {
  const double speed = gain_speed(state), length = ship.hull->length_m();
  const double time = length / speed;  // she needs it for her own length
  // A gear that is slow for so small a ship would be overrun: time is at least that of its swing.
  const double swing = std::max(time, 0.5 * ship.gear.limit_deg / ship.gear.rate_deg_s);
  const double wanted = std::clamp(left_rad / (2.5 * swing), -most_rate_rad, most_rate_rad);
  const double missing = wanted - state.motion.r;
  // Near the ordered course the integral takes out what stays.  It comes in smoothly: a threshold
  // would make a bit of difference in her motion a different track.
  const double steady = (1.0 - smooth_step(std::fabs(left_rad), 0.05, 0.15)) *
                        (1.0 - smooth_step(std::fabs(state.motion.r) / most_rate_rad, 0.25, 0.75));
  integral_deg_ += steady * left_rad * kDegreesPerRadian * tick_s / (10.0 * swing);
  integral_deg_ = std::clamp(integral_deg_, -15.0, 15.0);
  const double order = swing * (2.5 * missing + 0.8 * wanted) * kDegreesPerRadian + integral_deg_;
  // With sternway a rudder works the other way.
  const double sign = state.motion.u < -0.2 ? -1.0 : 1.0;
  return std::clamp(sign * order, -ship.gear.limit_deg, ship.gear.limit_deg);
}

double Helmsman::shaft_order(const ShipClass& ship, const DynamicState& state,
                             const HelmOrders& helm, double tick_s) {
  if (!helm.keeps_speed) {
    trim_rps_ = 0.0;
    return helm.lever >= 0.0 ? helm.lever * ship.ahead_rps : helm.lever * ship.astern_rps;
  }
  const double full = helm.speed_mps < 0.0 ? ship.astern_rps : ship.ahead_rps;
  const double missing = helm.speed_mps - state.motion.u;
  const double scale = full / ship.service_speed_mps;
  const double near = 1.0 - smooth_step(std::fabs(missing) / ship.service_speed_mps, 0.05, 0.15);
  trim_rps_ += near * scale * missing * tick_s / 60.0;
  trim_rps_ = std::clamp(trim_rps_, -0.4 * full, 0.4 * full);
  if (helm.speed_mps == 0.0 && std::fabs(state.motion.u) < 0.05) return 0.0;
  const double order = scale * helm.speed_mps + 2.0 * scale * missing + trim_rps_;
  return std::clamp(order, -ship.astern_rps, ship.ahead_rps);
}

ActuatorOrders Helmsman::orders(const ShipClass& ship, const DynamicState& state,
                                const HelmOrders& helm, const WayMade& ground,
                                const TrackView* track, double tick_s, bool& over) {
  over = false;
  ActuatorOrders conn;
  conn.shaft_rps = shaft_order(ship, state, helm, tick_s);
  conn.bow = helm.bow;
  conn.stern = helm.stern;
  if (helm.steering == SteeringMode::hand) {
    integral_deg_ = 0.0;
    conn.rudder_deg = helm.wheel_deg;
    return conn;
  }
  double most =
      helm.most_rate_deg_s > 0.0 ? helm.most_rate_deg_s : usual_rate_deg_s(ship, gain_speed(state));
  double course = helm.heading_deg * kRadiansPerDegree;
  if (helm.steering == SteeringMode::track && track != nullptr) {
    const double length = ship.hull->length_m(), speed = gain_speed(state);
    const double radius = helm.turn_radius_m > 0.0 ? helm.turn_radius_m : kUsualRadius * length;
    most = speed / radius * kDegreesPerRadian;
    const LegView leg = view_of(track->from, track->to);
    double before = 0.0;  // where the wheel is put over
    if (track->has_next) {
      const LegView next = view_of(track->to, track->next);
      const double turn = std::fabs(turned_within(next.course_rad - leg.course_rad));
      const double half = std::min(0.5 * turn, 1.3);
      const echo::SinCos tangent = sin_cos(half);
      // To turn she first needs the rudder and the rate: some two lengths.
      before = radius * tangent.sin / tangent.cos + (turn > 0.02 ? 1.5 * length : 0.0);
    }
    over = leg.left_m <= before;
    // Farther ahead than she needs to answer, or she would weave about the leg.
    const double ahead = std::clamp(3.0 * std::fabs(leg.off_m), 5.0 * length, 12.0 * length);
    course = leg.course_rad - echo::exact_atan2(leg.off_m, ahead);
    // What wind and current set her by: the course over ground is what the leg asks for.
    const double way = std::sqrt(squared(ground.north_m) + squared(ground.east_m));
    if (way > 0.5) {
      const double over_ground = echo::exact_atan2(ground.east_m, ground.north_m);
      course -= std::clamp(turned_within(over_ground - state.heading_rad), -0.7, 0.7);
    }
  }
  conn.rudder_deg = rudder_for(ship, state, turned_within(course - state.heading_rad),
                               most * kRadiansPerDegree, tick_s);
  return conn;
}

}  // namespace skerry::server
