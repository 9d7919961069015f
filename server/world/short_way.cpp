#include "server/world/short_way.hpp"

#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

constexpr double kEquator_m = 6378137.0;
constexpr double kEccentricity2 = 6.69437999014131705e-3;  // of WGS-84

// Metres for each degree of latitude and of longitude.
struct Degree {
  double north_m, east_m;
};

Degree degree_at(double latitude_deg) {
  const echo::SinCos latitude = echo::sin_cos_degrees(latitude_deg);
  const double w2 = 1.0 - kEccentricity2 * latitude.sin * latitude.sin;
  const double across = kEquator_m / std::sqrt(w2);  // radius of the prime vertical
  return {across * (1.0 - kEccentricity2) / w2 * kRadiansPerDegree,
          across * latitude.cos * kRadiansPerDegree};
}

double canonical(double degrees) {
  const double wrapped = std::remainder(degrees, 360.0);
  return wrapped >= 180.0 ? wrapped - 360.0 : wrapped;
}

}  // namespace

GeoPoint advanced(GeoPoint from, ShortWay way) {
  const double half = 0.5 * way.north_m / degree_at(from.latitude_deg).north_m;
  const Degree middle = degree_at(from.latitude_deg + half);
  return {from.latitude_deg + way.north_m / middle.north_m,
          canonical(from.longitude_deg + way.east_m / middle.east_m)};
}

ShortWay short_way_between(GeoPoint from, GeoPoint to) {
  const double north = to.latitude_deg - from.latitude_deg;
  const double east = std::remainder(to.longitude_deg - from.longitude_deg, 360.0);
  const Degree middle = degree_at(from.latitude_deg + 0.5 * north);
  return {north * middle.north_m, east * middle.east_m};
}

}  // namespace skerry::server
