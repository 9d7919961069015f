#include "server/world/hull_outline.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {
namespace {

double least_along(const HullOutline& outline, PlanePoint axis) {
  double least = dot(outline[0], axis);
  for (const PlanePoint corner : outline) least = std::min(least, dot(corner, axis));
  return least;
}

// The part of a straight way that is within all half-planes so far.
struct WayWithin {
  PlanePoint from, way;
  double begin = 0.0, end = 1.0;

  // Leaves what has at most `most` along `axis`; false if that is nothing.
  bool cut(PlanePoint axis, double most) {
    const double over = dot(from, axis) - most;
    const double change = dot(way, axis);
    if (change == 0.0) return over <= 0.0;
    const double share = -over / change;
    if (change > 0.0) {
      end = std::min(end, share);
    } else {
      begin = std::max(begin, share);
    }
    return begin <= end;
  }
};

}  // namespace

HullOutline hull_outline(double length_m, double beam_m, double heading_deg) {
  const echo::SinCos heading = echo::sin_cos_degrees(heading_deg);
  const double bow = 0.5 * length_m, shoulder = (0.5 - kBowShare) * length_m, side = 0.5 * beam_m;
  const auto placed = [&](double right, double ahead) {
    return echo::turned({right, ahead}, heading);
  };
  return {placed(0.0, bow), placed(side, shoulder), placed(side, -bow), placed(-side, -bow),
          placed(-side, shoulder)};
}

// The middles at which two convex outlines share a point are a convex area too: its edges are those
// of the one, and those of the other turned round.
std::optional<double> first_touch(const HullOutline& a, const HullOutline& b, PlanePoint from,
                                  PlanePoint to) {
  WayWithin within{from, to - from};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t next = (i + 1) % a.size();
    const PlanePoint edge_a = a[next] - a[i], edge_b = b[next] - b[i];
    const PlanePoint out_a{-edge_a.north_m, edge_a.east_m};
    if (!within.cut(out_a, dot(a[i], out_a) - least_along(b, out_a))) return std::nullopt;
    const PlanePoint out_b{-edge_b.north_m, edge_b.east_m};
    if (!within.cut(out_b * -1.0, dot(b[i], out_b) - least_along(a, out_b))) return std::nullopt;
  }
  return within.begin;
}

}  // namespace skerry::server
