// How much room a coast edge has before it meets another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// One straight edge of the chart's shoreline in a plane; land to the left.  The vertex ids say
// which edges join; `seed` is the edge's identity.
struct ShoreEdge {
  PlanePoint from, to;
  std::uint64_t from_id = 0, to_id = 0;
  std::uint64_t seed() const;
};

// Finds, for edges of a fixed set, the half-angle within which they may be refined so that no two
// refined edges ever meet but at the vertices they share:
//  - an edge that shares a vertex at angle gamma: half-angle at most 0.49 gamma;
//  - any other edge at distance d: height of the rhombus at most 0.47 d.
// Both rules are symmetric, so the result depends neither on order nor on what was refined before.
// Whatever keeps clear in the set keeps land and sea on their sides.  An edge on top of another
// gets no room and stays straight.
// Thread: one at a time (results are remembered).
class Clearance {
 public:
  // Keeps a reference to `edges`.
  explicit Clearance(std::span<const ShoreEdge> edges);

  // tan of the half-angle, 0 .. kMaxHalfAngleTan.  Error: none beyond double rounding.
  double half_angle_tan(std::uint32_t edge);

 private:
  double measure(const ShoreEdge& edge, std::uint32_t index) const;

  std::span<const ShoreEdge> edges_;
  std::vector<float> known_;  // -1 where not measured yet
  // A uniform grid in compressed rows: which edges pass through each square.
  PlanePoint origin_;
  double square_m_ = 1.0;
  std::int32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> square_start_, square_edges_;
};

// Least distance between segments p and q, metres; 0 where they cross.
double segment_distance(const ShoreEdge& p, const ShoreEdge& q);

}  // namespace skerry::echo
