#include "server/app/coastline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerDegree = 60.0 * 1852.0;
constexpr double kMostDetail = 4000.0;  // of a diameter

struct Point {
  double east_m = 0.0, north_m = 0.0;
};
using Polygon = std::vector<Point>;

// The part of a polygon on one side of a line, by Sutherland and Hodgman: `height` is positive
// there.
template <typename Height>
Polygon cut(const Polygon& polygon, const Height& height) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double over_a = height(a), over_b = height(b);
    if (over_a >= 0.0) out.push_back(a);
    if ((over_a >= 0.0) == (over_b >= 0.0)) continue;
    const double share = over_a / (over_a - over_b);
    out.push_back(
        {a.east_m + share * (b.east_m - a.east_m), a.north_m + share * (b.north_m - a.north_m)});
  }
  return out;
}

Polygon cut_to_square(Polygon polygon, double half_m) {
  polygon = cut(polygon, [=](const Point& p) { return half_m - p.east_m; });
  polygon = cut(polygon, [=](const Point& p) { return half_m + p.east_m; });
  polygon = cut(polygon, [=](const Point& p) { return half_m - p.north_m; });
  return cut(polygon, [=](const Point& p) { return half_m + p.north_m; });
}

Polygon thinned(const Polygon& polygon, double detail_m) {
  Polygon out;
  for (const Point& point : polygon) {
    if (!out.empty() && std::hypot(point.east_m - out.back().east_m,
                                   point.north_m - out.back().north_m) < detail_m) {
      continue;
    }
    out.push_back(point);
  }
  return out;
}

}  // namespace

wire::Coastline coastline_of(const echo::CoastChart& chart, const wire::GetCoastline& place,
                             std::size_t most_points) {
  const double half_m = place.radius_nm() * 1852.0;
  const double parallel = std::max(0.01, std::cos(degrees(place.latitude_deg()).in_radians()));
  struct Area {
    Polygon polygon;
    int level;
  };
  std::vector<Area> areas;
  for (const echo::CoastRing& ring : chart.rings) {
    Polygon polygon;
    polygon.reserve(ring.vertices.size());
    for (const GeoPoint& vertex : ring.vertices) {
      polygon.push_back({wrapped_longitude(vertex.longitude_deg - place.longitude_deg()) *
                             kMetresPerDegree * parallel,
                         (vertex.latitude_deg - place.latitude_deg()) * kMetresPerDegree});
    }
    polygon = cut_to_square(std::move(polygon), half_m);
    if (polygon.size() >= 3) areas.push_back({std::move(polygon), ring.level});
  }
  // Land first, then the lakes in it, then islands in those.
  const auto depth = [](int level) { return level >= 5 ? 1 : level; };
  std::stable_sort(areas.begin(), areas.end(),
                   [&](const Area& a, const Area& b) { return depth(a.level) < depth(b.level); });

  wire::Coastline out;
  out.set_latitude_deg(place.latitude_deg());
  out.set_longitude_deg(place.longitude_deg());
  out.set_radius_nm(place.radius_nm());
  out.set_chart(chart.source);
  double detail_m = 2.0 * half_m / kMostDetail;
  std::vector<Polygon> thin(areas.size());
  for (;; detail_m *= 2.0) {
    std::size_t points = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      thin[i] = thinned(areas[i].polygon, detail_m);
      if (thin[i].size() < 3) thin[i].clear();
      points += thin[i].size();
    }
    if (points <= most_points) break;
  }
  out.set_detail_m(detail_m);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (thin[i].empty()) continue;
    wire::Coastline::Line& line = *out.add_lines();
    line.set_closed(true);
    line.set_water(depth(areas[i].level) % 2 == 0);
    std::int64_t east = 0, north = 0;
    for (const Point& point : thin[i]) {
      const std::int64_t x = std::llround(point.east_m / (kMetresPerDegree * parallel) * 1e6);
      const std::int64_t y = std::llround(point.north_m / kMetresPerDegree * 1e6);
      line.add_points(static_cast<std::int32_t>(x - east));
      line.add_points(static_cast<std::int32_t>(y - north));
      east = x;
      north = y;
    }
  }
  return out;
}

}  // namespace skerry::server
