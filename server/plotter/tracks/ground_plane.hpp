// GroundPlane: the plane in which targets are tracked, near own ship, with north up.
#pragma once

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// A plane that does not move: over ground as far as own ship's positions are.  When own ship has
// left its middle it is laid anew, and what stands in it is carried over.
class GroundPlane {
 public:
  static constexpr double kReach_m = 10'000.0;  // own ship's way from the anchor

  explicit GroundPlane(GeoPoint anchor) : plane_(anchor) {}

  PlanePoint to_plane(GeoPoint point) const { return plane_.to_plane(point); }
  // Within 1e-6 m, in arithmetic of the same bits on every machine.
  GeoPoint to_geo(PlanePoint point) const;
  // What to add to an angle in the plane for the true one there, degrees.
  double true_less_plane_degrees(GeoPoint point) const { return -plane_.true_north_degrees(point); }
  bool is_far(PlanePoint own_ship) const { return dot(own_ship, own_ship) > kReach_m * kReach_m; }

 private:
  echo::LocalPlane plane_;
};

}  // namespace skerry::server
