// LocalPlane: the Earth around an anchor, as a plane.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Azimuthal equidistant about the anchor: range and true bearing from the anchor are right, so a
// radar picture needs no further projection.  Computed from the chord between the two points and
// the bearing of the normal section, in arithmetic that gives the same bits on every machine
// (exact_math.hpp), which GeographicLib's libm does not.
//
// Error against the WGS-84 geodesic from the anchor: range 0.02 m at 24 NM and 0.1 m at 96 NM,
// bearing 1e-4 deg.  From an own ship 5 km off the anchor: 0.2 m and 5e-4 deg more.  Valid to
// 250 NM.  Held by LocalPlane.RangeAndBearingMatchTheGeodesic.
class LocalPlane {
 public:
  explicit LocalPlane(GeoPoint anchor);

  GeoPoint anchor() const { return anchor_; }
  PlanePoint to_plane(GeoPoint point) const;
  // Inverse, by the geodesic (GeographicLib); to_plane(to_geo(p)) is p within the errors above.
  GeoPoint to_geo(PlanePoint point) const;

  // The direction of true north at `point`: degrees clockwise from the plane's north.  Away from
  // the anchor the meridians converge: 0.08 deg 5 km east of it at 60 N.  At a pole, north is the
  // direction of the meridian of the point's own longitude.
  double true_north_degrees(GeoPoint point) const;

 private:
  GeoPoint anchor_;
  double sin_lat_, cos_lat_;
  double x0_, z0_;                                // the anchor on its meridian plane, metres
  double meridian_curvature_, normal_curvature_;  // 1/M, 1/N at the anchor
};

}  // namespace skerry::echo
