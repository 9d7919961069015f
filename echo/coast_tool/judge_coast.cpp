#include "echo/coast_tool/judge_coast.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "echo/fractal/edge_refiner.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

CoastChart without_rings(const CoastChart& chart) {
  CoastChart empty;
  empty.centre = chart.centre;
  empty.radius_m = chart.radius_m;
  empty.source = chart.source;
  empty.shores = chart.shores;
  return empty;
}

// Splits a refined run at the vertices it was made between.  They are in it, in order.
void split_at(const std::vector<as_printed::PixelPoint>& vertices,
              const std::vector<as_printed::PixelPoint>& refined,
              const as_printed::Display& display, CoastPieces& pieces) {
  std::size_t at = 0;
  for (std::size_t v = 1; v < vertices.size(); ++v) {
    PlaneLine piece = {display.to_plane(refined[at])};
    do {
      if (++at >= refined.size())
        throw std::logic_error("a refined coast has lost a vertex of the chart");
      piece.push_back(display.to_plane(refined[at]));
    } while (!(refined[at] == vertices[v]));
    pieces.push_back(std::move(piece));
  }
}

}  // namespace

bool Contestant::random() const {
  if (const auto* style = std::get_if<CoastStyle>(&method)) return depends_on_seed(*style);
  const CoastMethod printed = std::get<as_printed::Parameters>(method).method;
  return printed == CoastMethod::random_koch || printed == CoastMethod::midpoint;
}

ThinnedCoast::ThinnedCoast(const CoastChart& chart, const CoastArea& area, int keep)
    : plane_(area.centre()), fine_(without_rings(chart)), coarse_(without_rings(chart)) {
  for (const CoastRing& ring : chart.rings) {
    if (ring.vertices.size() >= static_cast<std::size_t>(4 * keep)) thin_ring(ring, keep, area);
  }
  if (judged_.size() < 20)
    throw std::runtime_error(fmt::format(
        "only {} edges of the coast in {} are left when every {}th vertex is kept, expected at "
        "least 20. Take a larger area or keep more",
        judged_.size(), area.limits(), keep));
  clearance_ = Clearance(edges_);
}

void ThinnedCoast::thin_ring(const CoastRing& ring, int keep, const CoastArea& area) {
  const std::size_t n = ring.vertices.size();
  const auto is_shore = [&](std::size_t i) { return ring.edges[i % n] == EdgeKind::shoreline; };
  // From a vertex where the shoreline begins or ends, if there is one.
  std::size_t start = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_shore(i + n - 1) && is_shore(i)) continue;
    start = i;
    break;
  }
  CoastRing thinned;
  thinned.level = ring.level;
  PlaneLine piece;
  std::size_t from = start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n, next = (i + 1) % n;
    const PlanePoint here = plane_.to_plane(ring.vertices[i]);
    if (piece.empty()) {
      from = i;
      thinned.vertices.push_back(ring.vertices[i]);
      thinned.vertex_ids.push_back(ring.vertex_ids[i]);
      thinned.edges.push_back(ring.edges[i]);
      if (!ring.shores.empty()) thinned.shores.push_back(ring.shores[i]);
    }
    piece.push_back(here);
    const bool ends = !is_shore(i) || k + 1 == n || !is_shore(next) ||
                      piece.size() == static_cast<std::size_t>(keep);
    if (!ends) continue;
    piece.push_back(plane_.to_plane(ring.vertices[next]));
    if (is_shore(i) && ring.vertex_ids[from] != ring.vertex_ids[next]) {
      if (area.contains(ring.vertices[from]) && area.contains(ring.vertices[next])) {
        judged_.push_back(static_cast<std::uint32_t>(edges_.size()));
        real_.push_back(piece);
      }
      edges_.push_back({piece.front(), piece.back(), ring.vertex_ids[from], ring.vertex_ids[next]});
    }
    piece.clear();
  }
  fine_.rings.push_back(ring);
  coarse_.rings.push_back(std::move(thinned));
}

CoastPieces ThinnedCoast::chords() const {
  CoastPieces chords;
  for (const std::uint32_t e : judged_) chords.push_back({edges_[e].from, edges_[e].to});
  return chords;
}

CoastPieces ThinnedCoast::drawn_by(const Contestant& contestant, std::uint64_t seed,
                                   double detail_m) {
  if (const auto* parameters = std::get_if<as_printed::Parameters>(&contestant.method))
    return printed(*parameters, seed);
  const EdgeRefiner refiner(std::get<CoastStyle>(contestant.method));
  DetailLimit limit;
  limit.cell_m = 10.0 * detail_m;
  CoastPieces pieces;
  for (const std::uint32_t e : judged_) {
    const ShoreEdge& edge = edges_[e];
    PlaneLine piece = {edge.from};
    refiner.refine({edge.from, edge.to, mixed(edge.seed(), seed), clearance_.half_angle_tan(e)},
                   limit, piece);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

CoastPieces ThinnedCoast::printed(const as_printed::Parameters& parameters,
                                  std::uint64_t seed) const {
  const as_printed::Display display{{}, kDisplayRange_m, kDisplayPixels};
  CoastPieces pieces;
  std::vector<as_printed::PixelPoint> run;
  for (std::size_t k = 0; k < judged_.size(); ++k) {
    const ShoreEdge& edge = edges_[judged_[k]];
    if (run.empty()) run.push_back(display.to_pixel(edge.from));
    run.push_back(display.to_pixel(edge.to));
    const bool goes_on = k + 1 < judged_.size() && judged_[k + 1] == judged_[k] + 1 &&
                         edges_[judged_[k + 1]].from_id == edge.to_id;
    if (goes_on) continue;
    as_printed::Parameters own = parameters;
    own.seed = mixed(seed, k);
    split_at(run, as_printed::refine(run, own), display, pieces);
    run.clear();
  }
  // The ends went to pixels and back.
  for (std::size_t k = 0; k < judged_.size(); ++k) {
    pieces[k].front() = edges_[judged_[k]].from;
    pieces[k].back() = edges_[judged_[k]].to;
  }
  return pieces;
}

}  // namespace skerry::echo
