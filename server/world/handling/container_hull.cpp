#include "server/world/handling/container_hull.hpp"

#include <numbers>

#include "server/world/handling/cross_flow.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

// r' up to which the series is used as it is: tighter than she ever turns.  Where she turns faster
// for her speed, forces are those of the speed that fits.
constexpr double kContainerTightest = 0.8;

constexpr double kVolume_m3 = 21222.0, kMetacentre_m = 0.3;
constexpr double kMass = 0.00792, kAddedX = 0.000238, kAddedY = 0.007049;
constexpr double kRollInertia = 0.0000176 + 0.0000034, kYawInertia = 0.000456 + 0.000419;
constexpr double kAlphaY = 0.05, kLx = 0.0313, kLy = 0.0313;
constexpr double kPropeller_m = 6.533, kThrustDeduction = 0.175;
constexpr double kRudder_m2 = 33.0376, kAspect = 1.8219;
// Of the series; the righting lever grows beyond.
constexpr double kMostRoll_rad = 0.35;
// Of v' r' > 0, sway that drives her ahead: no published manoeuvre comes near it, and a hull thrown
// about by a storm gains no more speed from it.
constexpr double kMostDriven = 0.1;
constexpr double kContainerSlowest_mps = 1.5;
constexpr double kContainerAstern = 0.35;

// Forces of the propeller and of the rudder, in the prime system.
struct Aft {
  double thrust = 0.0, rudder = 0.0;
};

Aft aft_forces(double u, double v, double r, double speed, const Actuators& by) {
  const double n = by.shaft_rps;
  const double inflow = std::max(u, 0.0) * (0.816 + 1.09 * squared(v - 0.526 * r));
  double coefficient = 0.527;
  if (n > 0.0) {
    coefficient = 0.527 - 0.455 * std::min(inflow * speed / (n * kPropeller_m), 1.5);
  } else {
    coefficient *= kContainerAstern;
  }
  const double unit = squared(speed * ContainerHull::kLength_m);
  Aft aft;
  aft.thrust = 2.0 * squared(squared(kPropeller_m)) * coefficient * n * std::fabs(n) / unit;

  // 8 k KT / (pi J^2) times the inflow squared: finite when she stops.
  const double race = n > 0.0 ? 8.0 * 0.631 * std::max(coefficient, 0.0) / std::numbers::pi *
                                    squared(n * kPropeller_m / speed)
                              : 0.0;
  const double along =
      u < 0.0 ? u + 0.921 * std::sqrt(race) : 0.921 * std::sqrt(squared(inflow) + race);
  const double across = 0.088 * v - 0.156 * r - 0.275 * cubed(r) + 1.96 * r * r * v;
  const double angle =
      by.rudder_rad + (along > 0.0 ? echo::exact_atan2(across, along)
                                   : -echo::exact_atan2(across, std::max(-along, 1e-9)));
  const double flow = squared(along) + squared(across);
  aft.rudder = -(6.13 * kAspect / (kAspect + 2.25)) *
               (kRudder_m2 / squared(ContainerHull::kLength_m)) * flow * sin_cos(angle).sin *
               (along < 0.0 ? -1.0 : 1.0);
  return aft;
}

// What the hull's own motion does to her, in the prime system.
struct Series {
  double y = 0.0, k = 0.0, n = 0.0;
};

Series series(double v, double r, double p, double roll) {
  Series s;
  s.y = -0.0116 * v + 0.00242 * r - 0.000063 * roll - 0.109 * cubed(v) + 0.00177 * cubed(r) +
        0.0214 * v * v * r - 0.0405 * v * r * r + 0.04605 * v * v * roll +
        0.00304 * v * roll * roll + 0.009325 * r * r * roll - 0.001368 * r * roll * roll;
  s.k = 0.0003026 * v - 0.000063 * r - 0.0000075 * p - 0.000021 * roll + 0.002843 * cubed(v) -
        0.0000462 * cubed(r) - 0.000588 * v * v * r + 0.0010565 * v * r * r -
        0.0012012 * v * v * roll - 0.0000793 * v * roll * roll - 0.000243 * r * r * roll +
        0.00003569 * r * roll * roll;
  s.n = -0.0038545 * v - 0.00222 * r + 0.000213 * p - 0.0001424 * roll + 0.001492 * cubed(v) -
        0.00229 * cubed(r) - 0.0424 * v * v * r + 0.00156 * v * r * r - 0.019058 * v * v * roll -
        0.0053766 * v * roll * roll - 0.0038592 * r * r * roll + 0.0024195 * r * roll * roll;
  return s;
}

}  // namespace

BodyChange ContainerHull::change(const BodyMotion& motion, const Actuators& by, double /*depth_m*/,
                                 const Loads& outside) const {
  const double speed =
      std::max({std::sqrt(squared(motion.u) + squared(motion.v)),
                std::fabs(motion.r) * kLength_m / kContainerTightest, kContainerSlowest_mps});
  const double u = motion.u / speed, v = motion.v / speed;
  const double r = motion.r * kLength_m / speed, p = motion.p * kLength_m / speed;
  const double roll = std::clamp(motion.roll, -kMostRoll_rad, kMostRoll_rad);
  const Aft aft = aft_forces(u, v, r, speed, by);
  const echo::SinCos rudder = sin_cos(by.rudder_rad);
  const double weight = 2.0 * kGravity_mps2 * kVolume_m3 / squared(kLength_m * speed);

  const double heavy = smooth_step(std::fabs(motion.roll), 0.21, kMostRoll_rad);
  const double lever = motion.roll * (1.0 + heavy);
  Series hull = series(v, r, p, roll);
  const double unit = 0.5 * kSeaWater_kg_m3 * squared(kLength_m * speed);
  if (const double aside = broadside(motion, kLength_m); aside > 0.0) {
    const Loads strips = cross_flow(motion, kLength_m, kDraught_m);
    hull.y += aside * (strips.y / unit - hull.y);
    hull.n += aside * (strips.n / (unit * kLength_m) - hull.n);
  }
  const double side = aft.rudder * rudder.cos;
  const double fx = -0.0004226 * u * std::fabs(u) - 0.00311 * v * r + 0.0002 * r * r -
                    0.0002 * roll * roll - 0.00386 * v * v + (1.0 - kThrustDeduction) * aft.thrust +
                    0.71 * aft.rudder * rudder.sin +
                    (kMass + kAddedY) * std::min(v * r, kMostDriven) + outside.x / unit;
  const double fy = hull.y + 1.237 * side - (kMass + kAddedX) * u * r + outside.y / unit;
  const double fk = hull.k - 1.237 * 0.033 * side + kAddedX * kLx * u * r -
                    weight * kMetacentre_m / kLength_m * lever - heavy * 4e-6 * p * std::fabs(p) +
                    outside.k / (unit * kLength_m);
  const double fn = hull.n + (-0.5 - 0.237 * 0.48) * side + outside.n / (unit * kLength_m);

  const double m22 = kMass + kAddedY, m33 = kRollInertia, m44 = kYawInertia;
  const double m32 = -kAddedY * kLy, m42 = kAddedY * kAlphaY;
  const double det = m22 * m33 * m44 - m32 * m32 * m44 - m42 * m42 * m33;
  const double linear = squared(speed) / kLength_m, angular = linear / kLength_m;
  return {.u = fx * linear / (kMass + kAddedX),
          .v = (m33 * m44 * fy - m32 * m44 * fk - m42 * m33 * fn) / det * linear,
          .r = (-m42 * m33 * fy + m32 * m42 * fk + (m22 * m33 - m32 * m32) * fn) / det * angular,
          .p = (-m32 * m44 * fy + (m22 * m44 - m42 * m42) * fk + m32 * m42 * fn) / det * angular};
}

double ContainerHull::shaft_change(const Actuators& by, double ordered_rps) const {
  const double turns = std::fabs(by.shaft_rps);
  const double lag = turns > 0.3 ? 5.65 / turns : 18.83;
  return (ordered_rps - by.shaft_rps) / lag;
}

}  // namespace skerry::server
