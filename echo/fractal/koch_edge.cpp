#include "echo/fractal/koch_edge.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {

namespace {

// Heights allowed with T = tan(alpha), joints a, b and apex at c (parts of the edge):
//  - the outer corner of piece a-c lies under the parent's side:  h (1 + T^2) <= 2 a T; likewise
//    with 1 - b;
//  - the apex itself lies under both sides:                        h <= c T, (1 - c) T;
//  - the pieces at the apex fall apart at the vertical through it: slope + alpha < 90 deg, that is
//    h <= (c - a) / T, (b - c) / T; the same keeps them off the outer pieces at the joints.
double height_allowed(double a, double c, double b, double t) {
  double height = std::min(
      {2.0 * a * t / (1.0 + t * t), 2.0 * (1.0 - b) * t / (1.0 + t * t), c * t, (1.0 - c) * t});
  if (t > 0.0) height = std::min({height, (c - a) / t, (b - c) / t});
  return height;
}

void lay_joints(const CoastPiece& piece, const KochJoints& k, CoastPiece (&pieces)[4]) {
  const PlanePoint along = piece.to - piece.from;
  const PlanePoint left{-along.north_m, along.east_m};
  const PlanePoint first = piece.from + along * k.first;
  const PlanePoint apex = piece.from + along * k.apex_along + left * k.apex_height;
  const PlanePoint last = piece.from + along * k.last;
  pieces[0] = {piece.from, first, piece.seed};
  pieces[1] = {first, apex, piece.seed};
  pieces[2] = {apex, last, piece.seed};
  pieces[3] = {last, piece.to, piece.seed};
}

}  // namespace

KochJoints koch_joints(std::uint64_t seed, Roughness roughness) {
  const double r0 = as_unit(mixed(seed, 1)), r1 = as_unit(mixed(seed, 2));
  const double r2 = as_unit(mixed(seed, 3));
  const std::uint64_t h = mixed(seed, 4);
  const double a = 0.29 + 0.07 * r0;
  const double b = 0.64 + 0.07 * r1;
  const double c = a + (b - a) * (0.46 + 0.08 * r2);
  double height = height_allowed(a, c, b, roughness.half_angle_tan);
  const double share = 0.80 + 0.20 * as_unit(h);
  height *= roughness.apex_factor * share;
  return {a, c, b, (h & 1u) ? height : -height};
}

KochJoints regular_koch_joints(bool apex_on_left, Roughness roughness) {
  constexpr double kFirst = 1.0 / 3.0, kLast = 2.0 / 3.0;
  const double height =
      height_allowed(kFirst, 0.5, kLast, roughness.half_angle_tan) * roughness.apex_factor;
  return {kFirst, 0.5, kLast, apex_on_left ? height : -height};
}

void split(const CoastPiece& piece, Roughness roughness, CoastPiece (&pieces)[4]) {
  lay_joints(piece, koch_joints(piece.seed, roughness), pieces);
  for (std::uint64_t i = 0; i < 4; ++i) pieces[i].seed = mixed(piece.seed, 11 + i);
}

void split_regular(const CoastPiece& piece, Roughness roughness, CoastPiece (&pieces)[4]) {
  lay_joints(piece, regular_koch_joints((piece.seed & 1u) != 0, roughness), pieces);
}

}  // namespace skerry::echo
