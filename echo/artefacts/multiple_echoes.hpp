// Multiple echoes: what goes to and fro between the own hull and a big ship close by.
#pragma once

#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Bearings from `first_units` on clockwise, `width_units` wide, from the plane's north.
struct BearingSpan {
  std::uint32_t first_units = 0, width_units = 0;
  bool holds(std::uint32_t bearing_units) const {
    return bearing_units - first_units <= width_units;
  }
};

// The body that a false echo of `body` is: the same for all of its points, and no other's.
std::uint32_t false_body(std::uint32_t body, std::uint64_t way);

// The power of a second trip over that of the first.  The wave goes antenna - target - own
// hull - target - antenna, and each leg spreads over 4 pi R^2:
//   P1 = Pt G       / (4 pi R^2) * st / (4 pi R^2)                                * G lambda^2 / 4
//   pi P2 = Pt G       / (4 pi R^2) * st / (4 pi R^2) * so / (4 pi R^2) * st / (4 pi R^2) * G
//   lambda^2 / 4 pi P2 / P1 = so st / ((4 pi)^2 R^4), and P(n) = P1 times its (n-1)th power, at n
//   R.
// Close by a hull is no point but at most a flat mirror, whose cross-section is pi R^2, so neither
// is taken as more; the ratio is never over 1/16. Source: SOURCES.md "Propagation" and "Artefacts"
// (the chain; the mirror by images).  Error: lobing is that of the first trip on every one; hulls
// are as rough as their median cross-section says.
double second_trip_ratio(double own_m2, double target_m2, double range_m);

// The own hull's mean cross-section toward a bearing from the bow, as any ship's
// (echo/targets/ship_figure.hpp); 0 of no hull.
double own_cross_section(const OwnHull& own, double frequency_hz, std::uint32_t relative_units);

// Echoes that come back again at 2, 3 .. kMostTrips times the range, of bodies in `seen` within
// `where`.  A body's cross-section is that of all its points, which stand together in `seen`; its
// kMostPoints strongest points echo again, with all its power among them.
inline constexpr int kMostTrips = 4;
inline constexpr std::size_t kMostPoints = 24;
void add_multiple_echoes(const RadarModel& model, const Scene& scene, const SpokeAim& aim,
                         const BearingSpan& where, std::span<const PointEcho> seen,
                         std::vector<PointEcho>& out);

}  // namespace skerry::echo
