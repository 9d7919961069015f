#include "echo/chart/gdal/polygons/tangle.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "echo/chart/gdal/polygons/box_tree.hpp"

namespace skerry::echo {
namespace {

struct Edge {
  double ax, ay, bx, by;
  PlaneBox box() const {
    return {std::min(ax, bx), std::min(ay, by), std::max(ax, bx), std::max(ay, by)};
  }
};

// Which side of the edge's line the place lies on.
int side_of(const Edge& edge, double x, double y) {
  const double area = (edge.bx - edge.ax) * (y - edge.ay) - (edge.by - edge.ay) * (x - edge.ax);
  return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
}

bool share_an_end(const Edge& a, const Edge& b) {
  return (a.ax == b.ax && a.ay == b.ay) || (a.ax == b.bx && a.ay == b.by) ||
         (a.bx == b.ax && a.by == b.ay) || (a.bx == b.bx && a.by == b.by);
}

// Crossing, touching from the side, or lying on each other.
bool meet(const Edge& a, const Edge& b) {
  return !share_an_end(a, b) && side_of(a, b.ax, b.ay) * side_of(a, b.bx, b.by) <= 0 &&
         side_of(b, a.ax, a.ay) * side_of(b, a.bx, a.by) <= 0;
}

}  // namespace

std::string fault_of_tangle(const OGRPolygon& polygon, TangleBudget& budget) {
  std::vector<Edge> edges;
  std::vector<PlaneBox> boxes;
  for (const OGRLinearRing* ring : polygon) {
    for (int i = 0; i + 1 < ring->getNumPoints(); ++i) {
      edges.push_back({ring->getX(i), ring->getY(i), ring->getX(i + 1), ring->getY(i + 1)});
      boxes.push_back(edges.back().box());
    }
  }
  const std::size_t free = edges.size() * kComparisonsPerEdge;
  const std::size_t most = std::min(kMostCrossings, budget.crossings);
  std::size_t crossings = 0;
  const std::size_t allowed = free + budget.comparisons;
  const std::size_t made = BoxTree(boxes).join(allowed, [&](std::uint32_t i, std::uint32_t j) {
    crossings += meet(edges[i], edges[j]);
    return crossings > most;
  });
  budget.comparisons -= std::min(budget.comparisons, made > free ? made - free : 0);
  budget.crossings -= std::min(budget.crossings, crossings);
  if (crossings > kMostCrossings)
    return fmt::format("its edges cross more than {} times", kMostCrossings);
  if (crossings > most) return "its edges cross, as too many of this chart's do already";
  if (made > allowed)
    return fmt::format("its {} edges lie too close along each other to be checked", edges.size());
  return {};
}

}  // namespace skerry::echo
