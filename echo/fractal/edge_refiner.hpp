// EdgeRefiner: one chart edge grown into a coast, by one of the methods of coast_style.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "echo/fractal/coast_style.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// An edge of the chart and the room it has.  Everything that grows out of it stays in the rhombus
// whose diagonal it is, of half-angle atan(half_angle_tan) at its ends (clearance.hpp).
struct GrowingEdge {
  PlanePoint from, to;  // land on the left
  std::uint64_t seed = 0;
  double half_angle_tan = 0.0;
};

// The limit at which refinement may stop, for a radar at `centre` that can be anywhere within
// `slack_m` of it.
struct DetailLimit {
  PlanePoint centre = {};
  double slack_m = 0.0;
  double range_m = 1e12;       // beyond it nothing is refined
  double cell_m = 1.0;         // size of a range cell
  double spoke_radians = 0.0;  // angle between spokes
  // How far something must stand out from the straight line a - b to be made, metres: a tenth of a
  // cell or of a spoke's arc at the nearest place, whichever is more, at least 0.05; infinite out
  // of range.
  double visible_m(PlanePoint a, PlanePoint b) const {
    return visible_about((a + b) * 0.5, 0.6 * length_of(b - a));
  }
  // The same for something that lies within `reach_m` of `middle`.
  double visible_about(PlanePoint middle, double reach_m) const {
    const double nearest = std::max(0.0, length_of(middle - centre) - reach_m - slack_m);
    if (nearest > range_m) return std::numeric_limits<double>::infinity();
    return std::max(least_visible_m(), 0.1 * nearest * spoke_radians);
  }
  // The least visible_m() of all places.
  double least_visible_m() const { return std::max(0.1 * cell_m, 0.05); }
};

// The interface that every method of refinement has.  Thread: immutable, any number.
class EdgeMethod {
 public:
  virtual ~EdgeMethod() = default;
  // With the guarantees of EdgeRefiner::refine().
  virtual void refine(const GrowingEdge& edge, const DetailLimit& limit,
                      std::vector<PlanePoint>& out) const = 0;
};

// Makes a method that coast_methods() names, for a valid style of it.  Koch: the dimension is the
// similarity dimension in the widest envelope; the amplitude is a factor on the height of the
// apexes, up to what the envelope allows.
std::unique_ptr<const EdgeMethod> make_straight_method(const CoastStyle& style);
std::unique_ptr<const EdgeMethod> make_koch_method(const CoastStyle& style);
std::unique_ptr<const EdgeMethod> make_midpoint_method(const CoastStyle& style);
std::unique_ptr<const EdgeMethod> make_weierstrass_method(const CoastStyle& style);

// Thread: immutable, any number.  Copies share their tables.
class EdgeRefiner {
 public:
  // Error: std::invalid_argument as require_valid().
  explicit EdgeRefiner(const CoastStyle& style)
      : style_((require_valid(style), style)), method_(row_of(style.method).make(style)) {}

  const CoastStyle& style() const { return style_; }
  // Appends the vertices after edge.from, edge.to last.
  // Guarantees (edge_refiner_test): vertices made for one limit are among those made for any finer
  // one and never move; a pure function of its arguments; stays in the rhombus; never crosses or
  // touches itself.
  void refine(const GrowingEdge& edge, const DetailLimit& limit,
              std::vector<PlanePoint>& out) const {
    method_->refine(edge, limit, out);
  }

 private:
  CoastStyle style_;
  std::shared_ptr<const EdgeMethod> method_;
};

}  // namespace skerry::echo
