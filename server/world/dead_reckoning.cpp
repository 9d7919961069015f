#include "server/world/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/world/motion.hpp"

namespace skerry::server {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kEquatorialRadius = 6378137.0;  // WGS-84, metres
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);

struct Radii {
  double meridian;  // of curvature, north-south, metres
  double normal;    // of the prime vertical
};

Radii radii_at(double sine_of_latitude) {
  const double w2 = 1.0 - kEccentricitySquared * sine_of_latitude * sine_of_latitude;
  const double normal = kEquatorialRadius / std::sqrt(w2);
  return {normal * (1.0 - kEccentricitySquared) / w2, normal};
}

}  // namespace

Reckoned position_at(const ShipState& ship, Duration dt) {
  const double seconds = in_seconds(dt);
  const double half_turn = 0.5 * ship.rate_of_turn_deg_s * seconds;
  const double chord = ship.speed_mps * seconds * chord_over_arc(half_turn);
  const double course = (ship.course_over_ground_deg + half_turn) * kRadians;
  const double north = chord * std::cos(course);
  const double east = chord * std::sin(course);

  const double start = ship.position.latitude_deg * kRadians;
  const double rough = north / (2.0 * radii_at(std::sin(start)).meridian);
  const double middle = start + rough;
  const Radii radii = radii_at(std::sin(middle));
  double latitude = start + north / radii.meridian;
  // Nowhere nearer than a micrometre to a pole, so that the quotient is finite.
  const double parallel = std::max(radii.normal * std::fabs(std::cos(middle)), 1e-6);
  double longitude = ship.position.longitude_deg + east / parallel / kRadians;
  // Over the pole: down the meridian on the other side.
  constexpr double kPole = std::numbers::pi / 2.0;
  latitude = std::remainder(latitude, 4.0 * kPole);
  if (std::fabs(latitude) > kPole) {
    latitude = std::copysign(2.0 * kPole, latitude) - latitude;
    longitude += 180.0;
  }
  const double latitude_deg = std::clamp(latitude / kRadians, -90.0, 90.0);
  return {{latitude_deg, wrapped_longitude(std::remainder(longitude, 360.0))},
          wrapped_course(ship.heading_deg + 2.0 * half_turn)};
}

}  // namespace skerry::server
