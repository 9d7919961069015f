#include "server/world/handling/manoeuvres.hpp"

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

// A ship on trial: integrates and remembers what is measured.
class Run {
 public:
  Run(const ShipClass& ship, const Trial& trial)
      : ship_(ship), step_s_(trial.step_s), around_{.depth_m = trial.depth_m} {
    state.motion.u = trial.speed_mps;
    state.heading_rad = trial.heading_deg * kRadiansPerDegree;
    state.shaft_rps = trial.shaft_rps;
    first_deg_ = trial.heading_deg;
    orders.shaft_rps = trial.ordered_rps;
  }
  void step() {
    before_deg = turned_deg();
    before_north_m = north_m;
    before_east_m = east_m;
    const WayMade way = advance(ship_, orders, around_, step_s_, state);
    north_m += way.north_m;
    east_m += way.east_m;
    run_m += std::sqrt(squared(way.north_m) + squared(way.east_m));
    time_s += step_s_;
  }
  double turned_deg() const { return state.heading_rad * kDegreesPerRadian - first_deg_; }
  // How much of the last step was needed to turn to `deg`, 0 .. 1, to one side or the other.
  double share_to(double deg) const {
    const double now = turned_deg();
    return now == before_deg ? 1.0 : (deg - before_deg) / (now - before_deg);
  }
  double time_at(double share) const { return time_s + (share - 1.0) * step_s_; }

  DynamicState state;
  ActuatorOrders orders;
  double north_m = 0.0, east_m = 0.0, run_m = 0.0, time_s = 0.0;
  double before_deg = 0.0, before_north_m = 0.0, before_east_m = 0.0;

 private:
  const ShipClass& ship_;
  double step_s_, first_deg_ = 0.0;
  Surroundings around_;
};

}  // namespace

Trial trial_at_service(const ShipClass& ship) {
  return {.speed_mps = ship.service_speed_mps,
          .shaft_rps = ship.ahead_rps,
          .ordered_rps = ship.ahead_rps};
}

TurningCircle turning_circle(const ShipClass& ship, const Trial& trial, double rudder_deg) {
  constexpr double kSteady_s = 3600.0;
  Run run(ship, trial);
  run.orders.rudder_deg = rudder_deg;
  const double side = rudder_deg < 0.0 ? -1.0 : 1.0;
  TurningCircle circle;
  double next_deg = 90.0;
  while (run.time_s < kSteady_s) {
    run.step();
    circle.greatest_roll_deg =
        std::max(circle.greatest_roll_deg, std::fabs(run.state.motion.roll) * kDegreesPerRadian);
    if (next_deg > 360.0 || side * run.turned_deg() < next_deg) continue;
    const double share = run.share_to(side * next_deg);
    const double north = run.before_north_m + share * (run.north_m - run.before_north_m);
    const double east = run.before_east_m + share * (run.east_m - run.before_east_m);
    const echo::SinCos ahead = echo::sin_cos_degrees(trial.heading_deg);
    const double forward = north * ahead.cos + east * ahead.sin;
    const double aside = side * (east * ahead.cos - north * ahead.sin);
    if (next_deg == 90.0) {
      circle.advance_m = forward;
      circle.transfer_m = aside;
      circle.t90_s = run.time_at(share);
      next_deg = 180.0;
    } else if (next_deg == 180.0) {
      circle.tactical_diameter_m = aside;
      circle.t180_s = run.time_at(share);
      next_deg = 360.0;
    } else {
      circle.t360_s = run.time_at(share);
      next_deg = 1e9;
    }
  }
  const BodyMotion& m = run.state.motion;
  circle.speed_mps = std::sqrt(squared(m.u) + squared(m.v));
  circle.rate_deg_s = m.r * kDegreesPerRadian;
  circle.radius_m = m.r == 0.0 ? 0.0 : circle.speed_mps / std::fabs(m.r);
  circle.drift_deg = std::fabs(echo::exact_atan2(m.v, m.u)) * kDegreesPerRadian;
  circle.roll_deg = m.roll * kDegreesPerRadian;
  return circle;
}

ZigZag zig_zag(const ShipClass& ship, const Trial& trial, double rudder_deg, double heading_deg) {
  constexpr double kLongest_s = 3600.0;
  Run run(ship, trial);
  run.orders.rudder_deg = rudder_deg;
  double side = rudder_deg < 0.0 ? -1.0 : 1.0;
  ZigZag result;
  while (result.overshoot_deg.size() < 3 && run.time_s < kLongest_s) {
    run.step();
    if (side * run.turned_deg() < heading_deg) continue;
    if (result.reversal_s.empty()) result.run_to_10_m = run.run_m;
    result.reversal_s.push_back(run.time_at(run.share_to(side * heading_deg)));
    run.orders.rudder_deg = -run.orders.rudder_deg;
    double most = side * run.turned_deg();
    while (run.time_s < kLongest_s) {
      run.step();
      const double now = side * run.turned_deg();
      if (now < most) break;
      most = now;
    }
    result.overshoot_deg.push_back(most - heading_deg);
    side = -side;
  }
  return result;
}

Stopping stopping(const ShipClass& ship, const Trial& trial) {
  constexpr double kLongest_s = 7200.0;
  Run run(ship, trial);
  run.orders.shaft_rps = -ship.astern_rps;
  while (run.state.motion.u > 0.0 && run.time_s < kLongest_s) run.step();
  const echo::SinCos ahead = echo::sin_cos_degrees(trial.heading_deg);
  return {.track_reach_m = run.run_m,
          .time_s = run.time_s,
          .head_reach_m = run.north_m * ahead.cos + run.east_m * ahead.sin,
          .side_reach_m = run.east_m * ahead.cos - run.north_m * ahead.sin};
}

}  // namespace skerry::server
