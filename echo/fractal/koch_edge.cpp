#include "echo/fractal/koch_edge.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {

// Heights allowed with T = tan(alpha), joints a, b and apex at c (parts of the edge):
//  - the outer corner of piece a-c lies under the parent's side:  h (1 + T^2) <= 2 a T; likewise
//    with 1 - b;
//  - the apex itself lies under both sides:                        h <= c T, (1 - c) T;
//  - the pieces at the apex fall apart at the vertical through it: slope + alpha < 90 deg, that is
//    h <= (c - a) / T, (b - c) / T; the same keeps them off the outer pieces at the joints.
KochJoints koch_joints(std::uint64_t seed, Roughness roughness) {
  const double r0 = as_unit(mixed(seed, 1)), r1 = as_unit(mixed(seed, 2));
  const double r2 = as_unit(mixed(seed, 3));
  const std::uint64_t h = mixed(seed, 4);
  const double a = 0.29 + 0.07 * r0;
  const double b = 0.64 + 0.07 * r1;
  const double c = a + (b - a) * (0.46 + 0.08 * r2);
  const double t = roughness.half_angle_tan;
  double height = std::min(
      {2.0 * a * t / (1.0 + t * t), 2.0 * (1.0 - b) * t / (1.0 + t * t), c * t, (1.0 - c) * t});
  if (t > 0.0) height = std::min({height, (c - a) / t, (b - c) / t});
  const double share = 0.80 + 0.20 * as_unit(h);
  height *= roughness.apex_factor * share;
  return {a, c, b, (h & 1u) ? height : -height};
}

void split(const CoastPiece& piece, Roughness roughness, CoastPiece (&pieces)[4]) {
  const KochJoints k = koch_joints(piece.seed, roughness);
  const PlanePoint along = piece.to - piece.from;
  const PlanePoint left{-along.north_m, along.east_m};
  const PlanePoint first = piece.from + along * k.first;
  const PlanePoint apex = piece.from + along * k.apex_along + left * k.apex_height;
  const PlanePoint last = piece.from + along * k.last;
  pieces[0] = {piece.from, first, mixed(piece.seed, 11)};
  pieces[1] = {first, apex, mixed(piece.seed, 12)};
  pieces[2] = {apex, last, mixed(piece.seed, 13)};
  pieces[3] = {last, piece.to, mixed(piece.seed, 14)};
}

}  // namespace skerry::echo
