// The outline of a ship on the water, and when two of them touch.
#pragma once

#include <array>
#include <optional>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Five corners round a ship's middle, clockwise from the bow's point: the sides are parallel from
// the stern to a quarter of the length behind the bow, and meet there.
using HullOutline = std::array<PlanePoint, 5>;
inline constexpr double kBowShare = 0.25;  // of the length

// Metres, and degrees true.  The same bits on every machine.
HullOutline hull_outline(double length_m, double beam_m, double heading_deg);

// The first share of the way, 0 .. 1, at which `b` touches `a` if its middle goes straight from
// `from` to `to`, seen from the middle of `a`, and neither turns; nothing if they stay apart.
// Touching is sharing a point.  Exact but for rounding.  Cost: about 0.1 us.
std::optional<double> first_touch(const HullOutline& a, const HullOutline& b, PlanePoint from,
                                  PlanePoint to);
inline bool outlines_touch(const HullOutline& a, const HullOutline& b, PlanePoint way) {
  return first_touch(a, b, way, way).has_value();
}

}  // namespace skerry::server
