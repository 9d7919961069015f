#include "server/world/handling/ship_dynamics.hpp"

#include <array>

#include "protocol/quantity/speed.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr double kThrusterFade_mps = 2.5 * kKnot;

// All that Runge and Kutta integrate.
struct Vector {
  double north, east, heading, u, v, r, p, roll, shaft;

  Vector plus(const Vector& change, double h) const {
    return {north + h * change.north, east + h * change.east, heading + h * change.heading,
            u + h * change.u,         v + h * change.v,       r + h * change.r,
            p + h * change.p,         roll + h * change.roll, shaft + h * change.shaft};
  }
};

SteeringGear gear_of(const ShipClass& ship, const ActuatorOrders& orders) {
  SteeringGear gear = ship.gear;
  gear.rate_deg_s *= orders.rudder_speed;
  return gear;
}

class Rates {
 public:
  Rates(const ShipClass& ship, const ActuatorOrders& orders, const Surroundings& around,
        double rudder)
      : ship_(ship),
        orders_(orders),
        around_(around),
        gear_(gear_of(ship, orders)),
        rudder_deg_(rudder) {
    const echo::SinCos wind = echo::sin_cos_degrees(around.wind_from_deg);
    wind_north_ = -around.wind_mps * wind.cos;
    wind_east_ = -around.wind_mps * wind.sin;
    const echo::SinCos current = echo::sin_cos_degrees(around.current_set_deg);
    current_north_ = around.current_mps * current.cos;
    current_east_ = around.current_mps * current.sin;
  }

  Vector at(const Vector& s, double after_s) const {
    const echo::SinCos heading = sin_cos(s.heading);
    Vector change;
    const double upright = sin_cos(s.roll).cos;
    const double aside = s.v * upright;
    change.north = s.u * heading.cos - aside * heading.sin + current_north_;
    change.east = s.u * heading.sin + aside * heading.cos + current_east_;
    change.heading = s.r * upright;
    const BodyMotion motion{s.u, s.v, s.r, s.p, s.roll};
    const Actuators by{
        rudder_after(gear_, rudder_deg_, orders_.rudder_deg, after_s) * kRadiansPerDegree, s.shaft};
    const BodyChange hull =
        ship_.hull->change(motion, by, around_.depth_m, loads(s, heading, change, after_s));
    change.u = hull.u;
    change.v = hull.v;
    change.r = hull.r;
    change.p = hull.p;
    change.roll = s.p;
    change.shaft = ship_.hull->shaft_change(by, orders_.shaft_rps);
    return change;
  }

 private:
  Loads loads(const Vector& s, const echo::SinCos& heading, const Vector& ground,
              double after_s) const {
    Loads all;
    if (around_.wind_mps > 0.0) {
      const double north = wind_north_ - ground.north, east = wind_east_ - ground.east;
      const double x = north * heading.cos + east * heading.sin;
      const double y = east * heading.cos - north * heading.sin;
      all += ship_.isherwood ? isherwood_load(*ship_.isherwood, x, y)
                             : wind_load(ship_.wind, ship_.hull->length_m(), x, y);
    }
    if (around_.wave_height_m > 0.0) {
      all += wave_load(ship_.wave_shape(), around_.wave_height_m,
                       around_.waves_from_deg * kRadiansPerDegree - s.heading,
                       around_.time_s + after_s, around_.seed);
    }
    if (around_.banks.acts()) all += bank_load(around_.banks, s.u);
    const double fade = 1.0 / (1.0 + squared(s.u / kThrusterFade_mps));
    push(ship_.bow, orders_.bow * fade, all);
    push(ship_.stern, orders_.stern * fade, all);
    return all;
  }
  static void push(const Thruster& thruster, double share, Loads& all) {
    all.y += thruster.force_n * share;
    all.n += thruster.force_n * share * thruster.ahead_m;
  }

  const ShipClass& ship_;
  const ActuatorOrders& orders_;
  const Surroundings& around_;
  SteeringGear gear_;
  double rudder_deg_;
  double wind_north_, wind_east_, current_north_, current_east_;
};

}  // namespace

WayMade advance(const ShipClass& ship, const ActuatorOrders& orders, const Surroundings& around,
                double step_s, DynamicState& state) {
  const Rates rates(ship, orders, around, state.rudder_deg);
  const BodyMotion& m = state.motion;
  const Vector begin{0.0, 0.0, state.heading_rad, m.u, m.v, m.r, m.p, m.roll, state.shaft_rps};
  const double h = step_s;
  const Vector k1 = rates.at(begin, 0.0);
  const Vector k2 = rates.at(begin.plus(k1, 0.5 * h), 0.5 * h);
  const Vector k3 = rates.at(begin.plus(k2, 0.5 * h), 0.5 * h);
  const Vector k4 = rates.at(begin.plus(k3, h), h);
  const Vector end = begin.plus(k1, h / 6.0).plus(k2, h / 3.0).plus(k3, h / 3.0).plus(k4, h / 6.0);

  state.motion = {end.u, end.v, end.r, end.p, end.roll};
  state.heading_rad = end.heading;
  state.shaft_rps = end.shaft;
  state.rudder_deg = rudder_after(gear_of(ship, orders), state.rudder_deg, orders.rudder_deg, h);
  return {end.north, end.east};
}

DynamicState under_way(const ShipClass& ship, double heading_deg, double speed_mps) {
  DynamicState state;
  state.motion.u = speed_mps;
  state.heading_rad = heading_deg * kRadiansPerDegree;
  state.shaft_rps = shaft_for(*ship.hull, speed_mps);
  return state;
}

}  // namespace skerry::server
