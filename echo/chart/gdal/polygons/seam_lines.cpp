#include "echo/chart/gdal/polygons/seam_lines.hpp"

#include <algorithm>
#include <cmath>

#include "echo/chart/gdal/polygons/shared_edges.hpp"

namespace skerry::echo {
namespace {

struct Node {
  GeoPoint place;
  std::uint64_t identity;
};

// The ends of edges on the limits, in the order of latitude and of longitude.
class Nodes {
 public:
  void add(GeoPoint place) { by_latitude_.push_back({place, identity_of(place)}); }

  void sort() {
    std::sort(by_latitude_.begin(), by_latitude_.end(),
              [](const Node& a, const Node& b) { return a.identity < b.identity; });
    by_latitude_.erase(
        std::unique(by_latitude_.begin(), by_latitude_.end(),
                    [](const Node& a, const Node& b) { return a.identity == b.identity; }),
        by_latitude_.end());
    by_longitude_ = by_latitude_;
    std::sort(by_latitude_.begin(), by_latitude_.end(), [](const Node& a, const Node& b) {
      return a.place.latitude_deg < b.place.latitude_deg;
    });
    std::sort(by_longitude_.begin(), by_longitude_.end(), [](const Node& a, const Node& b) {
      return a.place.longitude_deg < b.place.longitude_deg;
    });
  }

  // Those between a and b, in turn.
  std::vector<Node> between(GeoPoint a, GeoPoint b) const {
    const double run = wrapped_longitude(b.longitude_deg - a.longitude_deg);
    const double rise = b.latitude_deg - a.latitude_deg;
    const double length2 = run * run + rise * rise;
    const std::uint64_t ids[2] = {identity_of(a), identity_of(b)};
    std::vector<std::pair<double, Node>> found;
    const auto look_at = [&](const Node& node) {
      const double x = wrapped_longitude(node.place.longitude_deg - a.longitude_deg);
      const double y = node.place.latitude_deg - a.latitude_deg;
      const double t = (x * run + y * rise) / length2;
      if (!(t > 0.0 && t < 1.0) || node.identity == ids[0] || node.identity == ids[1]) return;
      if (std::hypot(x - t * run, y - t * rise) <= CutLines::kTolerance) found.push_back({t, node});
    };
    constexpr double kSlack = CutLines::kTolerance;
    const bool across_antimeridian = std::abs(a.longitude_deg - b.longitude_deg) > 180.0;
    if (std::abs(rise) > std::abs(run) || across_antimeridian) {
      const auto less = [](const Node& n, double v) { return n.place.latitude_deg < v; };
      const double low = std::min(a.latitude_deg, b.latitude_deg) - kSlack;
      const double high = std::max(a.latitude_deg, b.latitude_deg) + kSlack;
      for (auto it = std::lower_bound(by_latitude_.begin(), by_latitude_.end(), low, less);
           it != by_latitude_.end() && it->place.latitude_deg <= high; ++it)
        look_at(*it);
    } else {
      const auto less = [](const Node& n, double v) { return n.place.longitude_deg < v; };
      const double low = std::min(a.longitude_deg, b.longitude_deg) - kSlack;
      const double high = std::max(a.longitude_deg, b.longitude_deg) + kSlack;
      for (auto it = std::lower_bound(by_longitude_.begin(), by_longitude_.end(), low, less);
           it != by_longitude_.end() && it->place.longitude_deg <= high; ++it)
        look_at(*it);
    }
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) {
      return p.first != q.first ? p.first < q.first : p.second.identity < q.second.identity;
    });
    std::vector<Node> nodes;
    for (const auto& [t, node] : found) nodes.push_back(node);
    return nodes;
  }

 private:
  std::vector<Node> by_latitude_, by_longitude_;
};

GeoPoint next_of(const CoastRing& ring, std::size_t i) {
  return ring.vertices[i + 1 == ring.vertices.size() ? 0 : i + 1];
}

// The ring with its edges on the limits divided; `on_limit` by edge becomes that of the new edges.
void divide(const Nodes& nodes, CoastRing& ring, std::vector<bool>& on_limit) {
  CoastRing divided;
  divided.level = ring.level;
  std::vector<bool> marks;
  for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
    const auto put = [&](GeoPoint place, std::uint64_t identity) {
      divided.vertices.push_back(place);
      divided.vertex_ids.push_back(identity);
      divided.edges.push_back(on_limit[i] ? EdgeKind::seam : ring.edges[i]);
      if (!ring.shores.empty()) divided.shores.push_back(ring.shores[i]);
      marks.push_back(on_limit[i]);
    };
    put(ring.vertices[i], ring.vertex_ids[i]);
    if (!on_limit[i]) continue;
    for (const Node& node : nodes.between(ring.vertices[i], next_of(ring, i)))
      put(node.place, node.identity);
  }
  ring = std::move(divided);
  on_limit = std::move(marks);
}

}  // namespace

void settle_seams(const CutLines& lines, std::vector<CoastRing>& rings) {
  std::vector<std::uint32_t> touched;
  std::vector<std::vector<bool>> on_limit;
  Nodes nodes;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    const CoastRing& ring = rings[r];
    std::vector<bool> marks;
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
      if (!lines.carries(ring.vertices[i], next_of(ring, i))) continue;
      marks.resize(ring.vertices.size());
      marks[i] = true;
      nodes.add(ring.vertices[i]);
      nodes.add(next_of(ring, i));
    }
    if (marks.empty()) continue;
    touched.push_back(r);
    on_limit.push_back(std::move(marks));
  }
  nodes.sort();
  std::vector<EdgeRef> edges;
  for (std::size_t k = 0; k < touched.size(); ++k) {
    CoastRing& ring = rings[touched[k]];
    divide(nodes, ring, on_limit[k]);
    for (std::uint32_t i = 0; i < ring.vertices.size(); ++i) {
      if (!on_limit[k][i]) continue;
      const std::uint64_t from = identity_of(ring.vertices[i]), to = identity_of(next_of(ring, i));
      edges.push_back({touched[k], i, EdgeName(from, to), from < to});
    }
  }
  settle_shared_edges(std::move(edges), rings);
}

}  // namespace skerry::echo
