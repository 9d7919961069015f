#include "echo/chart/local_plane.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "echo/chart/wgs84.hpp"
#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

double normal_radius(double sin_lat) {
  return wgs84::kSemiMajor / std::sqrt(1.0 - wgs84::kE2 * sin_lat * sin_lat);
}
}  // namespace

LocalPlane::LocalPlane(GeoPoint anchor) : anchor_(anchor) {
  const SinCos lat = sin_cos_degrees(anchor.latitude_deg);
  sin_lat_ = lat.sin;
  cos_lat_ = lat.cos;
  const double n = normal_radius(sin_lat_);
  x0_ = n * cos_lat_;
  z0_ = n * (1.0 - wgs84::kE2) * sin_lat_;
  normal_curvature_ = 1.0 / n;
  meridian_curvature_ = (1.0 - wgs84::kE2 * sin_lat_ * sin_lat_) / (n * (1.0 - wgs84::kE2));
}

PlanePoint LocalPlane::to_plane(GeoPoint point) const {
  const SinCos lat = sin_cos_degrees(point.latitude_deg);
  const SinCos lon =
      sin_cos_degrees(wrapped_longitude(point.longitude_deg - anchor_.longitude_deg));
  const double n = normal_radius(lat.sin);
  const double dx = n * lat.cos * lon.cos - x0_;
  const double east = n * lat.cos * lon.sin;
  const double dz = n * (1.0 - wgs84::kE2) * lat.sin - z0_;
  const double north = cos_lat_ * dz - sin_lat_ * dx;
  const double up = cos_lat_ * dx + sin_lat_ * dz;

  const double flat2 = east * east + north * north;
  // The anchor itself, or the opposite end of the Earth: as far as can be, in any direction.
  if (flat2 == 0.0) return {0.0, up < 0.0 ? 2e7 : 0.0};
  // Arc over chord c on a circle of the section's curvature k (Euler):
  // s = c (1 + (ck)^2/24 + 3 (ck)^4/640).
  const double k = (north * north * meridian_curvature_ + east * east * normal_curvature_) / flat2;
  const double chord2 = flat2 + up * up;
  const double q = chord2 * k * k;
  const double arc = std::sqrt(chord2) * (1.0 + q * (1.0 / 24.0 + q * (3.0 / 640.0)));
  const double stretch = arc / std::sqrt(flat2);
  return {east * stretch, north * stretch};
}

GeoPoint LocalPlane::to_geo(PlanePoint point) const {
  const double bearing = std::atan2(point.east_m, point.north_m) * kDegreesPerRadian;
  GeoPoint out;
  GeographicLib::Geodesic::WGS84().Direct(anchor_.latitude_deg, anchor_.longitude_deg, bearing,
                                          std::hypot(point.east_m, point.north_m), out.latitude_deg,
                                          out.longitude_deg);
  out.longitude_deg = wrapped_longitude(out.longitude_deg);
  return out;
}

double LocalPlane::true_north_degrees(GeoPoint point) const {
  // A step of 1e-4 deg (11 m) along the meridian, backwards where the pole is nearer than that.
  constexpr double kStep = 1e-4;
  GeoPoint south = point, north = point;
  south.latitude_deg = point.latitude_deg - kStep < -90.0 ? -90.0 : point.latitude_deg - kStep;
  north.latitude_deg = point.latitude_deg + kStep > 90.0 ? 90.0 : point.latitude_deg + kStep;
  const PlanePoint d = to_plane(north) - to_plane(south);
  return exact_atan2(d.east_m, d.north_m) * kDegreesPerRadian;
}

}  // namespace skerry::echo
