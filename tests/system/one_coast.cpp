#include "tests/system/one_coast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skerry::system_test {
namespace {

echo::CoastPicture in_plane(const CoastOnEarth& coast, GeoPoint anchor) {
  echo::CoastPicture picture{.plane = echo::LocalPlane(anchor),
                             .centre = {},
                             .vertices = {},
                             .run_starts = coast.run_starts};
  for (const GeoPoint& vertex : coast.vertices) {
    picture.vertices.push_back(picture.plane.to_plane(vertex));
  }
  return picture;
}

double distance_to_edge(PlanePoint p, PlanePoint a, PlanePoint b) {
  const double along_e = b.east_m - a.east_m, along_n = b.north_m - a.north_m;
  const double to_e = p.east_m - a.east_m, to_n = p.north_m - a.north_m;
  const double length2 = along_e * along_e + along_n * along_n;
  const double t =
      length2 > 0.0 ? std::clamp((to_e * along_e + to_n * along_n) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(to_e - t * along_e, to_n - t * along_n);
}

}  // namespace

CoastOnEarth on_earth(const echo::CoastPicture& picture) {
  CoastOnEarth coast{.vertices = {}, .run_starts = picture.run_starts};
  for (const PlanePoint& vertex : picture.vertices) {
    coast.vertices.push_back(picture.plane.to_geo(vertex));
  }
  return coast;
}

CoastSeenFrom::CoastSeenFrom(const CoastOnEarth& coast, GeoPoint own_ship, double slack_m)
    : picture_(in_plane(coast, own_ship)), index_(picture_, {}, slack_m) {
  // Edges are much shorter than kReach, so the first vertex's square is near enough.
  for (std::size_t run = 0; run + 1 < picture_.run_starts.size(); ++run) {
    for (std::uint32_t v = picture_.run_starts[run]; v + 1 < picture_.run_starts[run + 1]; ++v) {
      edges_.emplace_back(square_of(picture_.vertices[v]), v);
    }
  }
  std::sort(edges_.begin(), edges_.end());
}

CoastSeenFrom::Square CoastSeenFrom::square_of(PlanePoint point) {
  return {static_cast<int>(std::floor(point.east_m / kReach)),
          static_cast<int>(std::floor(point.north_m / kReach))};
}

double CoastSeenFrom::first_shore(GeoPoint own_ship, TrueBearing bearing) const {
  const TrueBearing in_plane = bearing + degrees(picture_.plane.true_north_degrees(own_ship));
  std::vector<echo::Crossing> crossings;
  echo::find_crossings(picture_, index_, {picture_.plane.to_plane(own_ship), in_plane.units()},
                       crossings);
  for (const echo::Crossing& crossing : crossings) {
    if (crossing.into_land) return crossing.range_m;
  }
  return std::numeric_limits<double>::infinity();
}

double CoastSeenFrom::distance(GeoPoint place) const {
  const PlanePoint point = picture_.plane.to_plane(place);
  const auto [east, north] = square_of(point);
  double nearest = kReach;
  for (int e = east - 1; e <= east + 1; ++e) {
    // Squares of one column follow one another.
    auto edge = std::lower_bound(edges_.begin(), edges_.end(),
                                 std::pair(Square{e, north - 1}, std::uint32_t{0}));
    for (; edge != edges_.end() && edge->first <= Square{e, north + 1}; ++edge) {
      nearest = std::min(nearest, distance_to_edge(point, picture_.vertices[edge->second],
                                                   picture_.vertices[edge->second + 1]));
    }
  }
  return nearest;
}

}  // namespace skerry::system_test
