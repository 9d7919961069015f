// Which of the equal sectors round a place each of many points lies in.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// out[i] = floor(bearing of points[i] from `from`, clockwise from north, in sectors), within 0 ..
// sectors - 1.  A pure function of the point, so that a line of points never jumps over a border
// unseen; but within 2e-6 rad of a border a point may count to the other side.  A point on the very
// spot lies in sector 0.  Error: 1.2e-6 rad + a unit in the last place of a float coordinate.  Held
// by BearingSector.IsOffByNoMoreThanItsBound.
// Requires sectors <= 65536 and points within 1e7 m.
void bearing_sectors(std::span<const PlanePoint> points, PlanePoint from, std::uint32_t sectors,
                     std::span<std::int32_t> out) noexcept;

}  // namespace skerry::echo
