#include "echo/chart/gdal/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skerry::echo {
namespace {

// Degrees east of `west`, 0 .. 360.
double east_of(double west, double longitude) {
  const double d = std::fmod(longitude - west, 360.0);
  return d < 0.0 ? d + 360.0 : d;
}

// Shortest way, degrees east.
double step_between(GeoPoint a, GeoPoint b) {
  return wrapped_longitude(b.longitude_deg - a.longitude_deg);
}

int crossings_south_of(const std::vector<GeoPoint>& ring, GeoPoint place) {
  int crossings = 0;
  GeoPoint a = ring.back();
  for (const GeoPoint b : ring) {
    const double ax = wrapped_longitude(a.longitude_deg - place.longitude_deg);
    const double bx = ax + step_between(a, b);
    if ((ax < 0.0) != (bx < 0.0)) {
      const double at = a.latitude_deg + (b.latitude_deg - a.latitude_deg) * (ax / (ax - bx));
      if (at < place.latitude_deg) ++crossings;
    }
    a = b;
  }
  return crossings;
}

}  // namespace

GeoBox box_around(const std::vector<GeoPoint>& line) {
  GeoBox box;
  if (line.empty()) return box;
  double x = 0.0, least = 0.0, most = 0.0;
  GeoPoint before = line.front();
  for (const GeoPoint p : line) {
    x += step_between(before, p);
    least = std::min(least, x);
    most = std::max(most, x);
    box.south_deg = std::min(box.south_deg, p.latitude_deg);
    box.north_deg = std::max(box.north_deg, p.latitude_deg);
    before = p;
  }
  const bool around = std::abs(x + step_between(before, line.front())) > 180.0;
  if (around || most - least >= 360.0) {
    box.west_deg = -180.0;
    box.width_deg = 360.0;
    // Which pole it encloses cannot be told from the line alone.
    if (around) {
      box.south_deg = -90.0;
      box.north_deg = 90.0;
    }
  } else {
    box.west_deg = wrapped_longitude(line.front().longitude_deg + least);
    box.width_deg = most - least;
  }
  return box;
}

GeoBox box_around(GeoPoint centre, double radius_m) {
  const double reach = 1.01 * radius_m / kLeastMetresPerDegree;
  GeoBox box;
  box.south_deg = std::max(-90.0, centre.latitude_deg - reach);
  box.north_deg = std::min(90.0, centre.latitude_deg + reach);
  const double farthest = std::max(std::abs(box.south_deg), std::abs(box.north_deg));
  const double shrink = std::cos(farthest * std::numbers::pi / 180.0);
  const double aside = shrink > 0.0 ? reach / shrink : 180.0;
  box.width_deg = std::min(360.0, 2.0 * aside);
  box.west_deg =
      aside >= 180.0 ? -180.0 : wrapped_longitude(std::fmod(centre.longitude_deg, 360.0) - aside);
  return box;
}

GeoBox joined(const GeoBox& a, const GeoBox& b) {
  if (a.width_deg < 0.0) return b;
  if (b.width_deg < 0.0) return a;
  GeoBox box{std::min(a.south_deg, b.south_deg), std::max(a.north_deg, b.north_deg), 0.0, 0.0};
  const double from_a = std::max(a.width_deg, east_of(a.west_deg, b.west_deg) + b.width_deg);
  const double from_b = std::max(b.width_deg, east_of(b.west_deg, a.west_deg) + a.width_deg);
  box.west_deg = from_a <= from_b ? a.west_deg : b.west_deg;
  box.width_deg = std::min(360.0, std::min(from_a, from_b));
  return box;
}

bool overlap(const GeoBox& a, const GeoBox& b) {
  if (a.width_deg < 0.0 || b.width_deg < 0.0) return false;
  if (a.north_deg < b.south_deg || b.north_deg < a.south_deg) return false;
  return east_of(a.west_deg, b.west_deg) <= a.width_deg ||
         east_of(b.west_deg, a.west_deg) <= b.width_deg;
}

bool Coverage::contains(GeoPoint place) const {
  if (everywhere()) return true;
  for (const CoveragePolygon& polygon : polygons) {
    int crossings = 0;
    for (const std::vector<GeoPoint>& ring : polygon) crossings += crossings_south_of(ring, place);
    if (crossings % 2 == 1) return true;
  }
  return false;
}

GeoBox Coverage::box() const {
  if (everywhere()) return {-90.0, 90.0, -180.0, 360.0};
  GeoBox box;
  for (const CoveragePolygon& polygon : polygons) box = joined(box, box_around(polygon.front()));
  return box;
}

}  // namespace skerry::echo
