#include "server/world/handling/mariner_hull.hpp"

#include "server/world/handling/cross_flow.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

// r' up to which the series is used as it is: tighter than she ever turns.  Where she turns faster
// for her speed, forces are those of the speed that fits.
constexpr double kMarinerTightest = 0.8;

// All in 1e-5 of the prime system.
constexpr double kUnit = 1e-5;
constexpr double kMassX = 798 + 42, kMassY = 798 + 748;
constexpr double kMassYr = 798 * -0.023 + 9.354;
constexpr double kMassNv = 798 * -0.023 - 4.646;
constexpr double kInertia = 39.2 + 43.8;

constexpr double kMarinerSlowest_mps = 1.5;  // of the series
constexpr double kMarinerShaftLag_s = 15.0;  // assumed
constexpr double kMarinerAstern = 0.6;
constexpr double kDrag = 92.0;

// What the series is a function of, in the prime system; d: of the rudder, positive to PORT.
struct Primes {
  double u, v, r, d;
};

double surge(const Primes& s) {
  const auto [u, v, r, d] = s;
  return -184 * u - 110 * u * u - 215 * u * u * u - 899 * v * v + 18 * r * r - 95 * d * d -
         190 * u * d * d + 798 * r * v + 93 * v * d + 93 * u * v * d;
}

double sway(const Primes& s) {
  const auto [u, v, r, d] = s;
  return -1160 * v - 499 * r - 8078 * v * v * v + 15356 * v * v * r - 1160 * v * u - 499 * r * u +
         278 * d - 90 * d * d * d + 556 * u * d + 278 * u * u * d - 4 * v * d * d +
         1190 * v * v * d - 4 - 8 * u - 4 * u * u;
}

double yaw(const Primes& s) {
  const auto [u, v, r, d] = s;
  return -264 * v - 166 * r + 1636 * v * v * v - 5483 * v * v * r - 264 * v * u - 166 * r * u -
         139 * d + 45 * d * d * d - 278 * u * d - 139 * u * u * d + 13 * v * d * d -
         489 * v * v * d + 3 + 6 * u + 3 * u * u;
}

}  // namespace

BodyChange MarinerHull::change(const BodyMotion& motion, const Actuators& by, double /*depth_m*/,
                               const Loads& outside) const {
  const double scale =
      std::max({std::sqrt(squared(motion.u) + squared(motion.v)),
                std::fabs(motion.r) * kLength_m / kMarinerTightest, kMarinerSlowest_mps});
  const double shaft_speed = kServiceSpeed_mps * by.shaft_rps / kServiceShaft_rps *
                             (by.shaft_rps < 0.0 ? kMarinerAstern : 1.0);
  const double off = (motion.u - shaft_speed) / scale;
  const double beyond = smooth_step(std::fabs(off), 0.4, 0.6);

  // Where she is far from her shaft's speed, the series has her at its own edge.
  const Primes near{std::clamp(off, -0.6, 0.6), motion.v / scale, motion.r * kLength_m / scale,
                    -by.rudder_rad};
  double x = surge(near);
  if (beyond > 0.0) {
    const double thrust = shaft_speed * std::fabs(shaft_speed);
    const Primes apart{0.0, near.v, near.r, near.d};
    const double squares = kDrag * (thrust - motion.u * std::fabs(motion.u)) / squared(scale);
    x += beyond * (squares + surge(apart) - x);
  }
  // A rudder turns her by the water that passes it: none when stopped, the other way astern.
  const double steers = std::clamp(motion.u / kMarinerSlowest_mps, -1.0, 1.0);
  Primes aside = near;
  aside.d *= steers;
  double y = sway(aside), n = yaw(aside);

  // To newtons and back: half rho L^2 U^2 is the unit of force.
  const double per_force = 1.0 / (0.5 * kSeaWater_kg_m3 * squared(kLength_m * scale) * kUnit);
  if (const double drifting = broadside(motion, kLength_m); drifting > 0.0) {
    const Loads strips = cross_flow(motion, kLength_m, kDraught_m);
    y += drifting * (strips.y * per_force - y);
    n += drifting * (strips.n * per_force / kLength_m - n);
  }
  const Pair turn = solved(kMassY, kMassYr, kMassNv, kInertia, y + outside.y * per_force,
                           n + outside.n * per_force / kLength_m);
  const double acceleration = squared(scale) / kLength_m;
  return {.u = (x + outside.x * per_force) / kMassX * acceleration,
          .v = turn.x * acceleration,
          .r = turn.y * acceleration / kLength_m};
}

double MarinerHull::shaft_change(const Actuators& by, double ordered_rps) const {
  return (ordered_rps - by.shaft_rps) / kMarinerShaftLag_s;
}

}  // namespace skerry::server
