// Refinement of one coast edge: the Koch curve, regular or with free joints, in a provable
// envelope.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A piece of coast between two fixed points; land lies to the left of from -> to.  `seed` follows
// from the chart edge's identity and the piece's place in it, so every host makes the same coast.
struct CoastPiece {
  PlanePoint from, to;
  std::uint64_t seed = 0;
};

// How rough an edge may be.  Everything that grows out of an edge of length L stays in the rhombus
// whose diagonal the edge is and whose half-angle at the ends is `half_angle_tan` = tan(alpha),
// 0 <= alpha <= 30 deg (0: the edge stays straight).  `apex_factor` in [0, kMaxApexFactor] says how
// much of the height that bound allows is used at most; regular edges may use
// kMaxRegularApexFactor.
struct Roughness {
  double half_angle_tan = 0.57735026918962576;
  double apex_factor = 0.0;
};
inline constexpr double kMaxApexFactor = 0.97;
inline constexpr double kMaxRegularApexFactor = 0.98;
inline constexpr double kMaxHalfAngleTan = 0.57735026918962576;  // 30 deg

// The three vertices put between the ends: two joints left where they are on the edge, and an apex
// beside it, displaced along the edge's normal.
struct KochJoints {
  double first, apex_along, last;  // along the edge, as parts of its length, ascending
  double apex_height;              // to the left, as part of the length, signed
};
KochJoints koch_joints(std::uint64_t seed, Roughness roughness);
// Joints at 1/3, 1/2, 2/3; the apex on the left or right.  With half-angle 30 deg and apex factor 1
// the curve of von Koch, which touches itself.
KochJoints regular_koch_joints(bool apex_on_left, Roughness roughness);

// Bound (envelope): each of the four pieces' rhombi, of the same half-angle, lies within the
// edge's, and no two of them share more than their common vertex.  So, by induction, a refined
// edge never crosses or touches itself at any depth, joins exactly at its ends, and keeps clear of
// all that keeps clear of its rhombus.  Held by KochEdge.PiecesStayInTheEnvelopeAndApart.
// Nested: vertices made at one level never move; deeper levels only add.
// Source: Ji et al. 2016 section 2 (random Koch curve), corrected as in SOURCES.md "Fractals" and
// "Corrections 1": the displacement is along the edge's normal, the apex is lowered below the
// touching height.
void split(const CoastPiece& piece, Roughness roughness, CoastPiece (&pieces)[4]);
// The same for the regular curve: every piece keeps the edge's seed, whose last bit is the side.
void split_regular(const CoastPiece& piece, Roughness roughness, CoastPiece (&pieces)[4]);

}  // namespace skerry::echo
