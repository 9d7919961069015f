#include "echo/scene/edge_detail.hpp"

#include <algorithm>
#include <cmath>

#include "echo/fractal/koch_edge.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {

double quarter_octave_floor(double x) {
  if (!(x > 0.0)) return 0.0;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [1/2, 1); exact
  double step = 0.5;
  for (double next : {0.59460355750136051, 0.70710678118654757, 0.84089641525371461}) {
    if (mantissa >= next) step = next;
  }
  return std::ldexp(step, exponent);
}

EdgeDetail detail_of(PlanePoint middle, double length_m, const DetailLimit& limit) {
  using Rule = EdgeDetail::Rule;
  // See DetailLimit::visible_m: all refinement of an edge lies within six tenths of its length.
  const double distance = length_of(middle - limit.centre);
  const double nearest = std::max(0.0, distance - 0.6 * length_m - limit.slack_m);
  const double farthest = distance + 0.6 * length_m;
  if (nearest > limit.range_m) return {Rule::straight, 0.0};
  EdgeDetail detail{Rule::whole, limit.cell_m};
  if (farthest * limit.spoke_radians > limit.cell_m) {
    if (length_m > 0.5 * nearest) detail.rule = Rule::by_piece;
    detail.cell_m = std::max(limit.cell_m, quarter_octave_floor(nearest) * limit.spoke_radians);
  }
  // Half of a rhombus' height at most.
  const double room = 0.5 * length_m * kMaxHalfAngleTan;
  if (room <= whole_edge_limit(detail.cell_m).least_visible_m()) return {Rule::straight, 0.0};
  return detail;
}

DetailLimit whole_edge_limit(double cell_m) {
  return {.centre = {}, .slack_m = 0.0, .range_m = 1e12, .cell_m = cell_m, .spoke_radians = 0.0};
}

}  // namespace skerry::echo
