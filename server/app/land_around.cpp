#include "server/app/land_around.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

// What a circle covers, a little more: degrees to either side of its centre.
double half_width_deg(GeoPoint centre, double radius_m) {
  const double parallel = std::max(0.05, std::cos(degrees(centre.latitude_deg).in_radians()));
  return std::min(179.0, radius_m / 111'000.0 / parallel);
}

}  // namespace

LandAround::LandAround(const echo::ChartSource& chart, GeoPoint centre, double radius_m)
    : LandAround(chart.load(centre, metres(radius_m)), centre, radius_m) {}

LandAround::LandAround(echo::CoastChart chart, GeoPoint centre, double radius_m)
    : chart_(std::move(chart)),
      lookup_(chart_.rings,
              wrapped_longitude(centre.longitude_deg - half_width_deg(centre, radius_m)),
              2.0 * half_width_deg(centre, radius_m),
              std::max(-90.0, centre.latitude_deg - radius_m / 110'000.0)) {}

}  // namespace skerry::server
