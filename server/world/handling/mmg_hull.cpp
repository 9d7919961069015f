#include "server/world/handling/mmg_hull.hpp"

#include <numbers>

#include "server/world/handling/cross_flow.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

// r' up to which the series is used as it is: tighter than she ever turns.  Where she turns faster
// for her speed, forces are those of the speed that fits.
constexpr double kMmgTightest = 1.5;

constexpr double kMmgAstern = 0.7;
constexpr double kDeep = 4.0, kMostShallow = 5.0;

}  // namespace

MmgHull::MmgHull(const MmgParticulars& particulars) : p_(particulars) {
  const double unit = 0.5 * kSeaWater_kg_m3 * squared(p_.length_m) * p_.draught_m;
  mass_kg_ = kSeaWater_kg_m3 * p_.volume_m3;
  added_x_kg_ = p_.added_x * unit;
  added_y_kg_ = p_.added_y * unit;
  inertia_kgm2_ = mass_kg_ * (squared(p_.gyradius * p_.length_m) + squared(p_.centre_m));
  added_inertia_kgm2_ = p_.added_inertia * unit * squared(p_.length_m);
}

MmgHull::Shallow MmgHull::shallow(double depth_m) const {
  if (depth_m >= kDeep * p_.draught_m) return {1.0, 1.0};
  const double clearance = std::max(depth_m - p_.draught_m, p_.draught_m / kMostShallow);
  // From nothing where she is four times as deep as the water.
  const double x = p_.draught_m / clearance - 1.0 / (kDeep - 1.0);
  return {1.0 + 0.1 * x, 1.0 + 0.3 * x};
}

Loads MmgHull::hull_forces(const BodyMotion& motion, const Shallow& shallow) const {
  const double way = std::sqrt(squared(motion.u) + squared(motion.v));
  const double turning = std::fabs(motion.r) * p_.length_m;
  const Loads strips = cross_flow(motion, p_.length_m, p_.draught_m);
  const double scale = std::max({way, turning / kMmgTightest, 1e-3});
  const double v = motion.v / scale, r = motion.r * p_.length_m / scale;
  const double unit = 0.5 * kSeaWater_kg_m3 * p_.length_m * p_.draught_m * squared(scale);
  // Ahead and astern alike, but nothing along her where she moves broadside.
  const double along = std::clamp(2.0 * motion.u / scale, -1.0, 1.0);

  Loads lift;
  const double drag = -p_.resistance * squared(way / scale) * along;
  const double turned =
      p_.x_vv * v * v + p_.x_vr * v * r + p_.x_rr * r * r + p_.x_vvvv * squared(squared(v));
  lift.x = unit * shallow.surge * (drag + turned * std::fabs(along));
  const double sign = along < 0.0 ? -1.0 : 1.0;  // the bow leads, or the stern
  const double y = shallow.sway * p_.y_v * v + p_.y_r * r * sign;
  const double n = shallow.sway * (p_.n_v * v * sign + p_.n_r * r);
  if (p_.cubic) {
    const MmgParticulars::Cubic& c = *p_.cubic;
    const double y3 = c.y_vvv * cubed(v) + c.y_vvr * v * v * r * sign + c.y_vrr * v * r * r +
                      c.y_rrr * cubed(r) * sign;
    const double n3 = c.n_vvv * cubed(v) * sign + c.n_vvr * v * v * r + c.n_vrr * v * r * r * sign +
                      c.n_rrr * cubed(r);
    lift.y = unit * (y + y3);
    lift.n = unit * p_.length_m * (n + n3);
    const double aside = broadside(motion, p_.length_m);
    lift.y += aside * (strips.y - lift.y);
    lift.n += aside * (strips.n - lift.n);
    return lift;
  }
  // Lift fades with the way ahead; cross-flow drag is always there.
  const double ahead = std::fabs(motion.u) / scale;
  lift.y = unit * ahead * y + strips.y;
  lift.n = unit * p_.length_m * ahead * n + strips.n;
  return lift;
}

double MmgHull::wake_of(double inflow_angle) const {
  if (!p_.turning_wake) return p_.wake * exact_exp(-4.0 * squared(inflow_angle));
  const MmgParticulars::TurningWake& w = *p_.turning_wake;
  const double c2 = inflow_angle > 0.0 ? w.c2_positive : w.c2_negative;
  const double grown = 1.0 + (1.0 - exact_exp(-w.c1 * std::fabs(inflow_angle))) * (c2 - 1.0);
  return 1.0 - (1.0 - p_.wake) * grown;
}

Loads MmgHull::aft_forces(const BodyMotion& motion, const Actuators& by) const {
  const double way = std::sqrt(squared(motion.u) + squared(motion.v));
  const double scale = std::max({way, std::fabs(motion.r) * p_.length_m / kMmgTightest, 1e-3});
  const double r = motion.r * p_.length_m / scale;
  const double drift = echo::exact_atan2(-motion.v, std::max(motion.u, 0.1 * scale));
  const double n = by.shaft_rps, diameter = p_.propeller_m;

  const double inflow = motion.u * (1.0 - wake_of(drift - p_.propeller_x * r));
  Loads loads;
  double coefficient = 0.0;
  if (n > 0.0) {
    const double j = std::clamp(inflow / (n * diameter), 0.0, 1.2);
    coefficient = p_.thrust_0 + p_.thrust_1 * j + p_.thrust_2 * j * j;
    const double thrust = kSeaWater_kg_m3 * squared(n) * squared(squared(diameter)) * coefficient;
    loads.x = (1.0 - p_.thrust_deduction) * thrust;
  } else if (n < 0.0) {
    const double thrust =
        -kSeaWater_kg_m3 * squared(n) * squared(squared(diameter)) * kMmgAstern * p_.thrust_0;
    loads.x = thrust;
    loads.y = p_.side_thrust * thrust;  // the stern to port
    loads.n = p_.propeller_x * p_.length_m * loads.y;
  }

  // The rudder, in the race where there is one.
  const double push =
      n > 0.0 ? 8.0 * std::max(coefficient, 0.0) * squared(n * diameter) / std::numbers::pi : 0.0;
  const double eta = std::clamp(diameter / p_.rudder_height_m, 0.0, 1.0);
  const double raced = inflow * (1.0 - p_.race) + p_.race * std::sqrt(squared(inflow) + push);
  const double flows = eta * raced * std::fabs(raced) + (1.0 - eta) * inflow * std::fabs(inflow);
  const double along = p_.wake_ratio * (flows < 0.0 ? -std::sqrt(-flows) : std::sqrt(flows));
  const double aside = drift - p_.straightening_x * r;
  const double across =
      scale * (aside < 0.0 ? p_.straightening_port : p_.straightening_starboard) * aside;
  const double flow = squared(along) + squared(across);
  // With the water from behind the rudder turns her the other way.
  const double facing = along < 0.0 ? -1.0 : 1.0;
  const double angle =
      by.rudder_rad - echo::exact_atan2(across * facing, std::max(std::fabs(along), 1e-6));
  const double force =
      0.5 * kSeaWater_kg_m3 * p_.rudder_m2 * p_.rudder_slope * flow * sin_cos(angle).sin * facing;
  const echo::SinCos rudder = sin_cos(by.rudder_rad);
  loads.x -= (1.0 - p_.rudder_deduction) * force * rudder.sin;
  loads.y -= (1.0 + p_.rudder_on_hull) * force * rudder.cos;
  loads.n -=
      p_.length_m * (p_.rudder_x + p_.rudder_on_hull * p_.rudder_on_hull_x) * force * rudder.cos;
  return loads;
}

BodyChange MmgHull::change(const BodyMotion& motion, const Actuators& by, double depth_m,
                           const Loads& outside) const {
  const Shallow bottom = shallow(depth_m);
  Loads all = hull_forces(motion, bottom);
  all += aft_forces(motion, by);
  all += outside;
  const double mx = mass_kg_ + added_x_kg_ * bottom.surge;
  const double my = mass_kg_ + added_y_kg_ * bottom.sway;
  const double gravity = p_.centre_m * mass_kg_;
  const double x = all.x + my * motion.v * motion.r + gravity * squared(motion.r);
  const Pair turn = solved(my, gravity, gravity, inertia_kgm2_ + added_inertia_kgm2_ * bottom.sway,
                           all.y - mx * motion.u * motion.r, all.n - gravity * motion.u * motion.r);
  return {.u = x / mx, .v = turn.x, .r = turn.y};
}

double MmgHull::shaft_change(const Actuators& by, double ordered_rps) const {
  const double left = ordered_rps - by.shaft_rps;
  constexpr double kLag_s = 6.0;
  return std::clamp(left / kLag_s, -p_.shaft_rate_rps2, p_.shaft_rate_rps2);
}

}  // namespace skerry::server
