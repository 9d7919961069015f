#include "server/world/handling/tanker_hull.hpp"

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr double kMass_kg = kSeaWater_kg_m3 * 220000.0;
constexpr double kTankerShaftLag_s = 50.0;
constexpr double kShallowest = 1.2;  // of the draught
constexpr double kMostDrift_rad = 1.0471975511965976;

}  // namespace

BodyChange TankerHull::change(const BodyMotion& motion, const Actuators& by, double depth_m,
                              const Loads& outside) const {
  const double u = motion.u, v = motion.v, r = motion.r, n = by.shaft_rps;
  const double depth = std::max(depth_m, kShallowest * kDraught_m);
  const double z = kDraught_m / (depth - kDraught_m);
  const double d = -by.rudder_rad;    // the source's is positive to port
  const double along = std::fabs(u);  // what damps her does so astern too
  const double drag = u * along;

  const double pull = 0.0000354 * kLength_m * std::fabs(n) * n - 0.00695 * drag / kLength_m -
                      0.00063 * u * (u < 0.0 ? std::fabs(n) : n);
  const double race = std::max(0.605 * u * std::max(n, 0.0) + (n > 0.0 ? 38.2 * n * n : 0.0), 0.0);
  const double c = n > 0.0 ? race : drag * 0.3;  // without a race: the rudder in the ship's way
  const double b = std::clamp(echo::exact_atan2(v, std::max(std::fabs(u), 1e-6)), -kMostDrift_rad,
                              kMostDrift_rad);
  const double side = std::fabs(b) * b * std::fabs(d);
  const double yuvz = z < 0.8 ? 0.0 : -0.85 * (1.0 - 0.8 / z);

  const double fx = -0.0377 * drag + 2.02 * kLength_m * v * r + 0.3 * v * v - 0.093 * c * d * d +
                    0.152 * c * b * d + 0.78 * kLength_m * pull - 0.0061 * drag * z +
                    0.387 * kLength_m * v * r * z + 0.0125 * v * v * z * z +
                    outside.x * kLength_m / kMass_kg;
  const double fy = -1.205 * along * v - 2.4 * std::fabs(v) * v + 0.208 * c * d -
                    0.752 * kLength_m * u * r - 2.16 * c * side + 0.04 * kLength_m * pull +
                    0.182 * kLength_m * u * r * z + yuvz * along * v * z -
                    1.5 * std::fabs(v) * v * z - 0.191 * c * side * z +
                    outside.y * kLength_m / kMass_kg;
  const double fn = -0.451 * u * v - 0.3 * kLength_m * std::fabs(v) * r - 0.098 * c * d -
                    0.231 * kLength_m * along * r + 0.688 * c * side - 0.02 * kLength_m * pull -
                    0.047 * kLength_m * along * r * z - 0.241 * u * v * z -
                    0.12 * kLength_m * std::fabs(v) * r * z + 0.344 * c * side * z +
                    outside.n / kMass_kg;
  return {.u = fx / ((1.050 + 0.05 * z) * kLength_m),
          .v = fy / ((2.020 + 0.387 * z) * kLength_m),
          .r = fn / ((0.1232 + 0.0045 * z) * squared(kLength_m))};
}

double TankerHull::shaft_change(const Actuators& by, double ordered_rps) const {
  return (ordered_rps - by.shaft_rps) / kTankerShaftLag_s;
}

}  // namespace skerry::server
