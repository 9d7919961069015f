#include "echo/fractal/edge_refiner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/fractal/dimension.hpp"
#include "echo/fractal/koch_edge.hpp"

namespace skerry::echo {
namespace {

double length_of(PlanePoint v) { return std::sqrt(v.east_m * v.east_m + v.north_m * v.north_m); }

void refine_koch(const CoastPiece& piece, Roughness roughness, const DetailLimit& limit,
                 std::vector<PlanePoint>& out) {
  // The apex stands out by at most half the length times the two factors.
  const double height =
      0.5 * length_of(piece.to - piece.from) * roughness.half_angle_tan * roughness.apex_factor;
  if (height <= limit.visible_m(piece.from, piece.to)) {
    out.push_back(piece.to);
    return;
  }
  CoastPiece pieces[4];
  split(piece, roughness, pieces);
  for (const CoastPiece& p : pieces) refine_koch(p, roughness, limit, out);
}

}  // namespace

double DetailLimit::visible_m(PlanePoint a, PlanePoint b) const {
  const double middle = length_of((a + b) * 0.5 - centre);
  const double nearest = std::max(0.0, middle - 0.6 * length_of(b - a) - slack_m);
  if (nearest > range_m) return std::numeric_limits<double>::infinity();
  return std::max({0.1 * cell_m, 0.1 * nearest * spoke_radians, 0.05});
}

EdgeRefiner::EdgeRefiner(const CoastStyle& style) : style_(style) {
  require_valid(style);
  apex_factor_ = apex_factor_for_dimension(style.dimension);
}

void EdgeRefiner::refine(const GrowingEdge& edge, const DetailLimit& limit,
                         std::vector<PlanePoint>& out) const {
  refine_koch({edge.from, edge.to, edge.seed}, {edge.half_angle_tan, apex_factor_}, limit, out);
}

}  // namespace skerry::echo
