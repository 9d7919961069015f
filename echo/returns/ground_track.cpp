#include "echo/returns/ground_track.hpp"

#include <cmath>

#include "echo/chart/wgs84.hpp"
#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
GroundTrack::GroundTrack(GeoPoint own_ship, PlanePoint sailed, std::uint32_t true_bearing_units)
    : own_ship_(own_ship), sailed_(sailed) {
  const SinCos bearing = sin_cos_units(true_bearing_units);
  sin_bearing_ = bearing.sin;
  cos_bearing_ = bearing.cos;
  const SinCos lat = sin_cos_degrees(own_ship.latitude_deg);
  sin_lat_ = lat.sin;
  cos_lat_ = lat.cos;
  const double flat = 1.0 - wgs84::kE2 * sin_lat_ * sin_lat_;
  const double n = wgs84::kSemiMajor / std::sqrt(flat);
  x0_ = n * cos_lat_;
  z0_ = n * (1.0 - wgs84::kE2) * sin_lat_;
  normal_curvature_ = 1.0 / n;
  meridian_curvature_ = flat / (n * (1.0 - wgs84::kE2));
}

GeoPoint GroundTrack::at(double range_m) const {
  const double east = sailed_.east_m + range_m * sin_bearing_;
  const double north = sailed_.north_m + range_m * cos_bearing_;
  const double flat2 = east * east + north * north;
  if (flat2 == 0.0) return own_ship_;
  // Along a circle of that curvature (Euler), arc s: across R sin(s/R), down R (1 - cos(s/R)).
  const double k = (north * north * meridian_curvature_ + east * east * normal_curvature_) / flat2;
  const double q = flat2 * k * k;
  const double shrink = 1.0 - q * (1.0 / 6.0) * (1.0 - q * (1.0 / 20.0));
  const double up = -0.5 * flat2 * k * (1.0 - q * (1.0 / 12.0) * (1.0 - q * (1.0 / 30.0)));
  const double x = x0_ + cos_lat_ * up - sin_lat_ * north * shrink;
  const double y = east * shrink;
  const double z = z0_ + sin_lat_ * up + cos_lat_ * north * shrink;
  // On the ellipsoid itself tan(latitude) = z / (p (1 - e^2)).
  return {exact_atan2(z, std::sqrt(x * x + y * y) * (1.0 - wgs84::kE2)) * kDegreesPerRadian,
          own_ship_.longitude_deg + exact_atan2(y, x) * kDegreesPerRadian};
}

}  // namespace skerry::echo
