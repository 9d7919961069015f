#include "server/navigation/target_geometry.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

// Slower than this relative to own ship, m/s, a target keeps her distance: her closest approach
// would be weeks away.
constexpr double kStill = 1e-3;

PlanePoint along(double course_deg, double length) {
  const double angle = degrees(course_deg).in_radians();
  return {length * std::sin(angle), length * std::cos(angle)};
}

}  // namespace

TargetPlace place_of(GeoPoint target, GeoPoint own) {
  TargetPlace place;
  double azimuth = 0.0, ignored = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(own.latitude_deg, own.longitude_deg, target.latitude_deg,
                                           target.longitude_deg, place.range_m, azimuth, ignored);
  place.bearing_deg = azimuth < 0.0 ? azimuth + 360.0 : azimuth;
  return place;
}

Approach approach_of(const TargetPlace& place, const TargetMotion& target,
                     const TargetMotion& own) {
  const PlanePoint at = along(place.bearing_deg, place.range_m);
  const PlanePoint velocity =
      along(target.course_deg, target.speed_mps) - along(own.course_deg, own.speed_mps);
  const double speed_squared = dot(velocity, velocity);
  if (speed_squared < kStill * kStill) return {place.range_m, 0.0};
  const double tcpa = -dot(at, velocity) / speed_squared;
  const PlanePoint closest = at + velocity * tcpa;
  return {length_of(closest), tcpa};
}

}  // namespace skerry::server
