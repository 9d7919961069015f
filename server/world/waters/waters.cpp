#include "server/world/waters/waters.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kNearest_m = 1.0;

Stream stream_of(double set_deg, double knots) {
  const echo::SinCos set = echo::sin_cos_degrees(set_deg);
  const double speed = knots_in_mps(knots);
  return {speed * set.cos, speed * set.sin};
}

Stream between(Stream a, Stream b, double share) {
  return {a.north_mps + share * (b.north_mps - a.north_mps),
          a.east_mps + share * (b.east_mps - a.east_mps)};
}

// Square of the distance on a sphere of 60 NM a degree, by the middle latitude: for weighing.
double distance_squared(GeoPoint a, GeoPoint b) {
  constexpr double kMetresADegree = 60.0 * 1852.0;
  const double north = kMetresADegree * (b.latitude_deg - a.latitude_deg);
  const double across = wrapped_longitude(b.longitude_deg - a.longitude_deg);
  const double east =
      kMetresADegree * across * echo::sin_cos_degrees(0.5 * (a.latitude_deg + b.latitude_deg)).cos;
  return north * north + east * east;
}

}  // namespace

Waters::Waters(const scenario::Scenario& scenario) : tide_(scenario.sea()) {
  for (const scenario::TidalDiamond& given : scenario.tidal_diamonds()) {
    Diamond diamond{{given.lat(), wrapped_longitude(given.lon())}, {}, {}};
    for (int hour = 0; hour < kHours; ++hour) {
      const scenario::HourlyStream& row = given.hours(hour);
      const auto k = static_cast<std::size_t>(hour);
      diamond.springs[k] = stream_of(row.set_deg(), row.springs_kn());
      diamond.neaps[k] = stream_of(row.set_deg(), row.neaps_kn());
    }
    diamonds_.push_back(diamond);
  }
}

Stream Waters::stream(GeoPoint at, Duration time) const {
  if (!has_streams()) return {};
  const double hour = tide_.hours_from_high_water(time) + 6.0;  // -0.21 .. 12.21
  std::size_t before = kHours - 1, after = 0;
  double share = 0.0;
  if (hour >= 0.0 && hour < 12.0) {
    before = static_cast<std::size_t>(hour);
    after = before + 1;
    share = hour - static_cast<double>(before);
  } else {
    const double since_last = hour >= 12.0 ? hour - 12.0 : hour + kTideHours - 12.0;
    share = std::clamp(since_last / (kTideHours - 12.0), 0.0, 1.0);
  }
  const double springs = tide_.springs(time);
  Stream sum;
  double weights = 0.0;
  for (const Diamond& diamond : diamonds_) {
    const double weight = 1.0 / std::max(distance_squared(at, diamond.at), kNearest_m * kNearest_m);
    const Stream here =
        between(between(diamond.neaps[before], diamond.neaps[after], share),
                between(diamond.springs[before], diamond.springs[after], share), springs);
    sum.north_mps += weight * here.north_mps;
    sum.east_mps += weight * here.east_mps;
    weights += weight;
  }
  return {sum.north_mps / weights, sum.east_mps / weights};
}

}  // namespace skerry::server
