#include "server/plotter/tracks/ground_plane.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {

GeoPoint GroundPlane::to_geo(PlanePoint point) const {
  // Newton's steps from the anchor, each by the scale of a sphere: the error falls some
  // thousandfold with each, from at most 200 km.
  constexpr double kMetresPerDegree = 111'194.9;
  GeoPoint found = plane_.anchor();
  for (int i = 0; i < 6; ++i) {
    const PlanePoint off = point - plane_.to_plane(found);
    const double turn = plane_.true_north_degrees(found);
    const PlanePoint along = echo::turned(off, echo::sin_cos_degrees(-turn));
    const double cosine = std::max(echo::sin_cos_degrees(found.latitude_deg).cos, 1e-3);
    found.latitude_deg =
        std::clamp(found.latitude_deg + along.north_m / kMetresPerDegree, -90.0, 90.0);
    found.longitude_deg =
        wrapped_longitude(found.longitude_deg + along.east_m / (kMetresPerDegree * cosine));
  }
  return found;
}

}  // namespace skerry::server
