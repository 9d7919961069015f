// Distances on the ellipsoid, for tests.
#pragma once

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Geodesic distance.  Good to some nanometres.
inline double metres_between(GeoPoint a, GeoPoint b) {
  double distance_m = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, distance_m);
  return distance_m;
}

inline bool is_sane(GeoPoint p) {
  return std::isfinite(p.latitude_deg) && std::isfinite(p.longitude_deg) &&
         std::fabs(p.latitude_deg) <= 90.0 && p.longitude_deg >= -180.0 && p.longitude_deg < 180.0;
}

// A straight step by geodesic: the reference for short steps, independent of Rhumb.
inline GeoPoint geodesic_step(GeoPoint from, double azimuth_deg, double distance_m) {
  GeoPoint to;
  GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, azimuth_deg,
                                          distance_m, to.latitude_deg, to.longitude_deg);
  return to;
}

}  // namespace skerry::server
