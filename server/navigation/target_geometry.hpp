// A target's place as own ship sees it, and its closest approach.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// On the WGS-84 ellipsoid.  Error: none that counts (GeographicLib, 15 nm).
struct TargetPlace {
  double range_m = 0.0;
  double bearing_deg = 0.0;  // true, [0, 360), at own ship
};
TargetPlace place_of(GeoPoint target, GeoPoint own);

// True courses and speeds over ground.
struct TargetMotion {
  double course_deg = 0.0;
  double speed_mps = 0.0;
};

// Both keep course and speed.  On the plane of range and bearing; a target that keeps her distance
// is closest now.
struct Approach {
  double cpa_m = 0.0;
  double tcpa_s = 0.0;  // negative: past
};
Approach approach_of(const TargetPlace& place, const TargetMotion& target, const TargetMotion& own);

}  // namespace skerry::server
