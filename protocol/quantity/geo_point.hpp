// Positions: on the Earth (GeoPoint) and on a local plane (PlanePoint).
#pragma once

#include <cmath>

namespace skerry {

// A position on the WGS-84 ellipsoid, degrees; latitude in [-90, 90], longitude in [-180, 180).
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  friend constexpr bool operator==(const GeoPoint&, const GeoPoint&) = default;
};

// Metres east and north of a local plane's anchor (echo/chart/local_plane.hpp says how exact).
struct PlanePoint {
  double east_m = 0.0;
  double north_m = 0.0;
  friend constexpr bool operator==(const PlanePoint&, const PlanePoint&) = default;
  friend constexpr PlanePoint operator+(PlanePoint a, PlanePoint b) {
    return {a.east_m + b.east_m, a.north_m + b.north_m};
  }
  friend constexpr PlanePoint operator-(PlanePoint a, PlanePoint b) {
    return {a.east_m - b.east_m, a.north_m - b.north_m};
  }
  friend constexpr PlanePoint operator*(PlanePoint a, double k) {
    return {a.east_m * k, a.north_m * k};
  }
};

// A PlanePoint also stands for the way between two places.  Plain arithmetic and sqrt, not hypot:
// the same bits on every machine, and coordinates are far from overflow.
constexpr double dot(PlanePoint a, PlanePoint b) {
  return a.east_m * b.east_m + a.north_m * b.north_m;
}
// Positive where b points to the left of a.
constexpr double cross(PlanePoint a, PlanePoint b) {
  return a.east_m * b.north_m - a.north_m * b.east_m;
}
inline double length_of(PlanePoint v) { return std::sqrt(dot(v, v)); }

// `degrees` brought into [-180, 180).
constexpr double wrapped_longitude(double degrees) {
  while (degrees >= 180.0) degrees -= 360.0;
  while (degrees < -180.0) degrees += 360.0;
  return degrees;
}

}  // namespace skerry
