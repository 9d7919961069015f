#include "echo/chart/gdal/polygons/shared_edges.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace skerry::echo {

std::vector<EdgeRef> edges_of(const std::vector<CoastRing>& rings) {
  std::vector<EdgeRef> edges;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    const CoastRing& ring = rings[r];
    for (std::uint32_t i = 0; i < ring.edges.size(); ++i) {
      if (ring.edges[i] == EdgeKind::bin_border) continue;
      const std::uint64_t from = ring.vertex_ids[i];
      const std::uint64_t to = ring.vertex_ids[i + 1 == ring.edges.size() ? 0 : i + 1];
      edges.push_back({r, i, EdgeName(from, to), from < to});
    }
  }
  return edges;
}

void settle_shared_edges(std::vector<EdgeRef> edges, std::vector<CoastRing>& rings) {
  std::sort(edges.begin(), edges.end(), [](const EdgeRef& a, const EdgeRef& b) {
    return std::tie(a.name.low, a.name.high, a.ring, a.edge) <
           std::tie(b.name.low, b.name.high, b.ring, b.edge);
  });
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    int sum = 0;
    for (; end < edges.size() && edges[end].name == edges[begin].name; ++end)
      sum += edges[end].forward ? 1 : -1;
    int left = std::abs(sum);
    for (; begin < end; ++begin) {
      const EdgeRef& e = edges[begin];
      const bool point = e.name.low == e.name.high;
      if (!point && left > 0 && e.forward == (sum > 0)) {
        --left;
      } else {
        rings[e.ring].edges[e.edge] = EdgeKind::bin_border;
      }
    }
  }
}

}  // namespace skerry::echo
