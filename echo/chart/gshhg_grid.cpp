#include "echo/chart/gshhg_grid.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

// The least radius of curvature of WGS-84, of the meridian at the equator: a sphere of this radius
// under the same latitudes and longitudes has no distance longer than the ellipsoid's.
constexpr double kLeastRadius = 6335439.0;
static_assert(kLeastRadius / 6399594.0 > 0.988, "greatest radius: at the poles");

// Angle, radians, from a place at latitude `from` to the nearest of the meridian `apart` radians
// away, between the latitudes `south` and `north`.
double angle_to_meridian(double from, double apart, double south, double north) {
  const double foot = std::atan2(std::sin(from), std::cos(from) * std::cos(apart));
  const auto cosine_to = [&](double latitude) {
    return std::sin(from) * std::sin(latitude) +
           std::cos(from) * std::cos(latitude) * std::cos(apart);
  };
  double cosine = std::max(cosine_to(south), cosine_to(north));
  if (foot > south && foot < north) cosine = std::max(cosine, cosine_to(foot));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

GshhgGrid::GshhgGrid(int bin_minutes) : minutes_(bin_minutes) {}

double GshhgGrid::north_of(int bin) const { return 90.0 - (bin / columns()) * minutes_ / 60.0; }

double GshhgGrid::south_of(int bin) const { return 90.0 - (bin / columns() + 1) * minutes_ / 60.0; }

double GshhgGrid::west_of(int bin) const {
  return wrapped_longitude((bin % columns()) * minutes_ / 60.0);
}

GshhgGrid::GlobePoint GshhgGrid::on_globe(int bin, BinPoint point) const {
  const std::int64_t column = bin % columns(), row_from_south = rows() - 1 - bin / columns();
  return {(column * kUnits + point.x) % (columns() * kUnits), row_from_south * kUnits + point.y};
}

GeoPoint GshhgGrid::position(int bin, BinPoint point) const {
  GlobePoint p = on_globe(bin, point);
  if (2 * p.east >= columns() * kUnits) p.east -= columns() * kUnits;
  constexpr std::int64_t kPerDegree = 60 * kUnits;
  return {static_cast<double>(p.north * minutes_ - 90 * kPerDegree) / kPerDegree,
          static_cast<double>(p.east * minutes_) / kPerDegree};
}

std::uint64_t GshhgGrid::identity(int bin, BinPoint point) const {
  GlobePoint p = on_globe(bin, point);
  if (p.north == 0 || p.north == rows() * kUnits) p.east = 0;
  return static_cast<std::uint64_t>(p.north) << 32 | static_cast<std::uint64_t>(p.east);
}

double GshhgGrid::nearest_metres(GeoPoint from, int bin) const {
  const double south = south_of(bin), north = north_of(bin);
  const double from_west = wrapped_longitude(from.longitude_deg - west_of(bin));
  const double from_east = wrapped_longitude(from_west - minutes_ / 60.0);
  double angle;
  if (from_west >= 0.0 && from_west <= minutes_ / 60.0) {
    angle =
        std::max({0.0, from.latitude_deg - north, south - from.latitude_deg}) * kRadiansPerDegree;
  } else {
    const double apart = std::min(std::abs(from_west), std::abs(from_east));
    angle = angle_to_meridian(from.latitude_deg * kRadiansPerDegree, apart * kRadiansPerDegree,
                              south * kRadiansPerDegree, north * kRadiansPerDegree);
  }
  return angle * kLeastRadius;
}

std::vector<BinRun> GshhgGrid::bins_within(GeoPoint centre, double radius_m) const {
  std::vector<BinRun> runs;
  const double reach = radius_m / kLeastRadius / kRadiansPerDegree;
  for (int row = 0; row < rows(); ++row) {
    const int first = row * columns();
    if (south_of(first) > centre.latitude_deg + reach ||
        north_of(first) < centre.latitude_deg - reach)
      continue;
    bool adjoins = false;
    for (int bin = first; bin < first + columns(); ++bin) {
      const bool wanted = nearest_metres(centre, bin) <= radius_m;
      if (wanted && adjoins) {
        ++runs.back().count;
      } else if (wanted) {
        runs.push_back({bin, 1});
      }
      adjoins = wanted;
    }
  }
  return runs;
}

}  // namespace skerry::echo
