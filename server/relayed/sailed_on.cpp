#include "server/relayed/sailed_on.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::server {

GeoPoint moved(GeoPoint from, double course_deg, double distance_m) {
  constexpr double kMetresPerDegree = 60.0 * Length::kMetresPerNauticalMile;
  const double course = degrees(course_deg).in_radians();
  const double north_deg = distance_m * std::cos(course) / kMetresPerDegree;
  const double parallel = std::max(0.01, std::cos(degrees(from.latitude_deg).in_radians()));
  const double east_deg = distance_m * std::sin(course) / (kMetresPerDegree * parallel);
  return {std::clamp(from.latitude_deg + north_deg, -90.0, 90.0),
          wrapped_longitude(from.longitude_deg + east_deg)};
}

}  // namespace skerry::server
