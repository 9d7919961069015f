#include "tests/unit/scene/coast_helpers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "echo/fractal/clearance.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo::test {

GeoPoint place(GeoPoint centre, double east_m, double north_m) {
  constexpr double kDegree = 111195.0;
  const double latitude = centre.latitude_deg + north_m / kDegree;
  const double cosine = std::cos(centre.latitude_deg * std::numbers::pi / 180.0);
  return {latitude, wrapped_longitude(centre.longitude_deg + east_m / (kDegree * cosine))};
}

CoastRing ring(GeoPoint centre, const std::vector<PlanePoint>& places) {
  CoastRing r;
  for (const PlanePoint& p : places) {
    r.vertices.push_back(place(centre, p.east_m, p.north_m));
    r.vertex_ids.push_back(mixed(std::bit_cast<std::uint64_t>(r.vertices.back().latitude_deg),
                                 std::bit_cast<std::uint64_t>(r.vertices.back().longitude_deg)));
  }
  r.edges.assign(places.size(), EdgeKind::shoreline);
  return r;
}

CoastRing island(GeoPoint centre, PlanePoint middle, double radius_m, int corners, double rough,
                 std::uint64_t seed) {
  std::vector<PlanePoint> places;
  for (int k = 0; k < corners; ++k) {
    const double at = 2.0 * std::numbers::pi * k / corners;
    const double r = radius_m * (1.0 - rough * as_unit(mixed(seed, static_cast<std::uint64_t>(k))));
    places.push_back(middle + PlanePoint{r * std::cos(at), r * std::sin(at)});
  }
  return ring(centre, places);
}

CoastChart chart(std::vector<CoastRing> rings, double radius_m, GeoPoint centre) {
  CoastChart c;
  c.centre = centre;
  c.radius_m = radius_m;
  c.source = "made up";
  c.rings = std::move(rings);
  return c;
}

RadarResolution resolution(double nm, std::uint32_t cells, std::uint32_t spokes) {
  return {nm * 1852.0, nm * 1852.0 / cells, 360.0 / spokes};
}

CoastRules all_by(CoastMethod method, double dimension) {
  CoastRules rules{.seed = 1};
  for (CoastStyle& style : rules.styles) {
    style.method = method;
    style.dimension = std::min(dimension, greatest_dimension(method));
  }
  return rules;
}

bool identical(const CoastPicture& a, const CoastPicture& b) {
  const bool structures =
      (a.structures == nullptr) == (b.structures == nullptr) &&
      (!a.structures || (a.structures->walls.size() == b.structures->walls.size() &&
                         a.structures->points.size() == b.structures->points.size()));
  return structures && a.centre == b.centre && a.slack_m == b.slack_m && a.range_m == b.range_m &&
         a.centre_ashore == b.centre_ashore && a.vertices == b.vertices &&
         a.run_starts == b.run_starts && a.shores == b.shores && a.edge_shores == b.edge_shores;
}

VertexSet vertices_of(const CoastPicture& picture) {
  VertexSet set;
  for (const PlanePoint& v : picture.vertices) set.insert({v.east_m, v.north_m});
  return set;
}

std::vector<Chain> chains_of(const CoastPicture& picture, const CoastPicture& straight) {
  const VertexSet corners = vertices_of(straight);
  std::vector<Chain> chains;
  for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
    Chain chain{picture.run_starts[run], {}};
    for (std::uint32_t v = picture.run_starts[run]; v < picture.run_starts[run + 1]; ++v) {
      const PlanePoint p = picture.vertices[v];
      chain.points.push_back(p);
      if (chain.points.size() > 1 && corners.count({p.east_m, p.north_m}) > 0) {
        chains.push_back(std::move(chain));
        chain = {v, {p}};
      }
    }
  }
  return chains;
}

int meetings(const std::vector<Chain>& chains) {
  struct Piece {
    ShoreEdge edge;
    bool refined;
  };
  std::vector<Piece> pieces;
  double length = 0.0;
  for (const Chain& chain : chains) {
    const auto& points = chain.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      pieces.push_back({{points[i], points[i + 1], 0, 0}, points.size() > 2});
      length += std::hypot(points[i + 1].east_m - points[i].east_m,
                           points[i + 1].north_m - points[i].north_m);
    }
  }
  if (pieces.empty()) return 0;
  const double square = std::max(1.0, 3.0 * length / static_cast<double>(pieces.size()));
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares;
  // The squares of the boxes of as many parts as the piece is squares long: all it passes through.
  const auto for_each_square = [&](const ShoreEdge& e, auto&& visit) {
    const auto of = [&](double m) { return static_cast<std::int64_t>(std::floor(m / square)); };
    const double reach = std::hypot(e.to.east_m - e.from.east_m, e.to.north_m - e.from.north_m);
    const int parts = static_cast<int>(reach / square) + 1;
    for (int k = 0; k < parts; ++k) {
      const PlanePoint a = e.from + (e.to - e.from) * (static_cast<double>(k) / parts);
      const PlanePoint b = e.from + (e.to - e.from) * ((k + 1.0) / parts);
      const auto [x0, x1] = std::minmax({of(a.east_m), of(b.east_m)});
      const auto [y0, y1] = std::minmax({of(a.north_m), of(b.north_m)});
      for (std::int64_t x = x0; x <= x1; ++x) {
        for (std::int64_t y = y0; y <= y1; ++y)
          visit(mixed(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)));
      }
    }
  };
  int count = 0;
  std::vector<std::uint32_t> compared_with(pieces.size(), ~std::uint32_t{0});
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const Piece& p = pieces[i];
    for_each_square(p.edge, [&](std::uint64_t key) {
      auto& others = squares[key];
      for (const std::uint32_t j : others) {
        const Piece& q = pieces[j];
        if (j == i || compared_with[j] == i || (!p.refined && !q.refined)) continue;
        compared_with[j] = i;
        const bool joins = p.edge.from == q.edge.from || p.edge.from == q.edge.to ||
                           p.edge.to == q.edge.from || p.edge.to == q.edge.to;
        if (!joins) count += segment_distance(p.edge, q.edge) <= 0.0;
      }
      if (others.empty() || others.back() != i) others.push_back(i);
    });
  }
  return count;
}

int winding(const CoastPicture& picture, PlanePoint from) {
  int sum = 0;
  for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
    for (std::uint32_t v = picture.run_starts[run]; v + 1 < picture.run_starts[run + 1]; ++v) {
      const PlanePoint a = picture.vertices[v] - from, b = picture.vertices[v + 1] - from;
      if ((a.north_m < 0.0) == (b.north_m < 0.0)) continue;
      const double east = a.east_m + (b.east_m - a.east_m) * (a.north_m / (a.north_m - b.north_m));
      if (east > 0.0) sum += a.north_m < 0.0 ? 1 : -1;
    }
  }
  return sum;
}

}  // namespace skerry::echo::test
