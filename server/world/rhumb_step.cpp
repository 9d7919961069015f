#include "server/world/rhumb_step.hpp"

#include <GeographicLib/Rhumb.hpp>
#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

// GeographicLib keeps 180; this project's longitudes end before it.
double canonical_longitude(double degrees) {
  const double wrapped = std::remainder(degrees, 360.0);
  return wrapped >= 180.0 ? wrapped - 360.0 : wrapped;
}

}  // namespace

RhumbEnd advanced(GeoPoint from, double course_deg, double distance_m) {
  if (distance_m == 0.0) return {{from.latitude_deg, canonical_longitude(from.longitude_deg)}};
  if (std::fabs(distance_m) <= kShortWay_m &&
      std::fabs(from.latitude_deg) < kShortWayLatitude_deg) {
    const echo::SinCos course = echo::sin_cos_degrees(course_deg);
    return {advanced(from, ShortWay{distance_m * course.cos, distance_m * course.sin})};
  }
  double latitude = 0.0, longitude = 0.0;
  GeographicLib::Rhumb::WGS84().Direct(from.latitude_deg, from.longitude_deg, course_deg,
                                       distance_m, latitude, longitude);
  const bool over_pole = !std::isfinite(longitude);
  if (over_pole) longitude = from.longitude_deg + 180.0;
  return {{std::clamp(latitude, -90.0, 90.0), canonical_longitude(longitude)}, over_pole};
}

}  // namespace skerry::server
