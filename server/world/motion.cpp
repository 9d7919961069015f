#include "server/world/motion.hpp"

#include <GeographicLib/Math.hpp>
#include <GeographicLib/Rhumb.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skerry::server {
namespace {

// A metre from the pole: 111694 m of meridian to the degree there.
constexpr double kLastLatitude = 90.0 - 1.0 / 111694.0;

double bounded(double latitude_deg) {
  return std::clamp(latitude_deg, -kLastLatitude, kLastLatitude);
}

}  // namespace

double wrapped_course(double course_deg) {
  if (!std::isfinite(course_deg)) return 0.0;
  double course = std::fmod(course_deg, 360.0);
  if (course < 0.0) course += 360.0;
  return course < 360.0 ? course : 0.0;
}

double chord_over_arc(double half_turn_deg) {
  const double x = half_turn_deg * (std::numbers::pi / 180.0);
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

double rhumb_length_m(GeoPoint start, double course_deg) {
  const double north = GeographicLib::Math::cosd(course_deg);
  if (north == 0.0) return std::numeric_limits<double>::infinity();
  double meridian_m = 0.0, azimuth = 0.0;
  GeographicLib::Rhumb::WGS84().Inverse(bounded(start.latitude_deg), 0.0,
                                        std::copysign(kLastLatitude, north), 0.0, meridian_m,
                                        azimuth);
  return meridian_m / std::fabs(north);
}

GeoPoint rhumb_destination(GeoPoint start, double course_deg, double distance_m) {
  if (distance_m < 0.0) return rhumb_destination(start, course_deg + 180.0, -distance_m);
  const double latitude = bounded(start.latitude_deg);
  // No degree of latitude is shorter than 110 km.
  if (std::fabs(latitude) + distance_m / 110e3 > 89.0) {
    distance_m = std::min(distance_m, rhumb_length_m(start, course_deg));
  }
  GeoPoint end;
  GeographicLib::Rhumb::WGS84().Direct(latitude, start.longitude_deg, course_deg, distance_m,
                                       end.latitude_deg, end.longitude_deg);
  end.longitude_deg = wrapped_longitude(end.longitude_deg);
  return end;
}

}  // namespace skerry::server
