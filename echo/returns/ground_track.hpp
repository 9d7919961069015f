// Latitude and longitude along a ray.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// The track of a ray from the own ship over the Earth, for rasters of latitude and longitude: along
// the ellipsoid's normal section as a circle of the curvature it has at the own ship. Error against
// the WGS-84 geodesic: bound_m(), for own ships to 89.4 deg of latitude.  Held by
// GroundTrack.FollowsTheGeodesicWithinItsBound.
class GroundTrack {
 public:
  // From `own_ship` after she has `sailed`, metres.
  GroundTrack(GeoPoint own_ship, PlanePoint sailed, std::uint32_t true_bearing_units);

  // The longitude is not wrapped: it runs on across the antimeridian.
  GeoPoint at(double range_m) const;

  // At range s, metres: 0.015 m at 24 NM, 0.09 m at 96 NM.
  static constexpr double bound_m(double range_m) {
    return 0.01 + 0.005 * (range_m / 44448.0) * (range_m / 44448.0);
  }

 private:
  GeoPoint own_ship_;
  PlanePoint sailed_;
  double sin_bearing_, cos_bearing_;
  double sin_lat_, cos_lat_;
  double x0_, z0_;                                // the own ship on her meridian plane, metres
  double meridian_curvature_, normal_curvature_;  // 1/M, 1/N
};

}  // namespace skerry::echo
