#include "echo/coast_tool/coast_lines.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "echo/measure/ruler_walk.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

// Consecutive edges of one ring.
struct Piece {
  std::uint64_t first = 0, last = 0;  // identities of its ends
  PlaneLine points;
};

GeoPoint middle_of(GeoPoint a, GeoPoint b) {
  const double east = wrapped_longitude(b.longitude_deg - a.longitude_deg);
  return {(a.latitude_deg + b.latitude_deg) / 2.0, wrapped_longitude(a.longitude_deg + east / 2.0)};
}

void cut_ring(const CoastChart& chart, const CoastRing& ring, const LocalPlane& plane,
              const CoastArea& area, std::optional<CoastType> type, std::vector<Piece>& pieces) {
  const std::size_t n = ring.vertices.size();
  const auto is_wanted = [&](std::size_t i) {
    return ring.edges[i] == EdgeKind::shoreline &&
           area.contains(middle_of(ring.vertices[i], ring.vertices[(i + 1) % n])) &&
           (!type || shore_of(chart, ring, i).type == *type);
  };
  // Begin behind an edge that is left out, so that no piece is cut where the ring begins.
  std::size_t begin = 0;
  while (begin < n && is_wanted(begin)) ++begin;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (begin + k) % n, next = (i + 1) % n;
    if (!is_wanted(i)) continue;
    const PlanePoint from = plane.to_plane(ring.vertices[i]);
    const bool goes_on = k > 0 && !pieces.empty() && pieces.back().last == ring.vertex_ids[i] &&
                         pieces.back().points.back() == from;
    if (!goes_on) pieces.push_back({ring.vertex_ids[i], 0, {from}});
    pieces.back().last = ring.vertex_ids[next];
    pieces.back().points.push_back(plane.to_plane(ring.vertices[next]));
  }
}

// Pieces that end where another begins, one after the other.
std::vector<PlaneLine> joined(std::vector<Piece> pieces) {
  std::unordered_multimap<std::uint64_t, std::size_t> by_first;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].first != pieces[i].last) by_first.emplace(pieces[i].first, i);
  }
  std::vector<bool> has_before(pieces.size()), used(pieces.size());
  for (const Piece& piece : pieces) {
    if (piece.first == piece.last) continue;
    const auto next = by_first.find(piece.last);
    if (next != by_first.end()) has_before[next->second] = true;
  }
  std::vector<PlaneLine> lines;
  const auto follow = [&](std::size_t i) {
    PlaneLine line;
    while (true) {
      used[i] = true;
      line.insert(line.end(), pieces[i].points.begin() + (line.empty() ? 0 : 1),
                  pieces[i].points.end());
      const auto next = by_first.find(pieces[i].last);
      if (pieces[i].first == pieces[i].last || next == by_first.end() || used[next->second]) break;
      i = next->second;
    }
    lines.push_back(std::move(line));
  };
  for (const bool open : {true, false}) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (!used[i] && !(open && has_before[i])) follow(i);
    }
  }
  return lines;
}

}  // namespace

CoastLines coast_lines(const CoastChart& chart, const LocalPlane& plane, const CoastArea& area,
                       std::optional<CoastType> type) {
  std::vector<Piece> pieces;
  for (const CoastRing& ring : chart.rings) cut_ring(chart, ring, plane, area, type, pieces);
  CoastLines out;
  out.lines = joined(std::move(pieces));
  std::vector<double> spacings;
  for (const PlaneLine& line : out.lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      spacings.push_back(distance(line[i], line[i + 1]));
      out.length_m += spacings.back();
    }
  }
  out.edges = spacings.size();
  if (spacings.empty()) return out;
  std::sort(spacings.begin(), spacings.end());
  out.median_spacing_m = spacings[spacings.size() / 2];
  out.mean_spacing_m = out.length_m / static_cast<double>(spacings.size());
  out.p90_spacing_m = spacings[spacings.size() * 9 / 10];
  return out;
}

PlaneLine stretch_of(const PlaneLine& line, double from_m, double to_m) {
  PlaneLine out;
  double at = 0.0;
  for (std::size_t i = 0; i + 1 < line.size() && at < to_m; ++i) {
    const double edge = distance(line[i], line[i + 1]), end = at + edge;
    if (end > from_m && edge > 0.0) {
      const auto point = [&](double where) {
        return line[i] + (line[i + 1] - line[i]) * std::clamp((where - at) / edge, 0.0, 1.0);
      };
      if (out.empty()) out.push_back(point(from_m));
      out.push_back(point(to_m));
    }
    at = end;
  }
  return out;
}

}  // namespace skerry::echo
