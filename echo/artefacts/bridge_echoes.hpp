// Multiple echoes of bridges.
#pragma once

#include <vector>

#include "echo/artefacts/multiple_echoes.hpp"

namespace skerry::echo {

// A bridge again at 2, 3 .. kMostTrips times its range, as multiple_echoes.hpp has it for ships: a
// bridge returns 0 dB of the height and arc it shows (SOURCES.md "Land"), what the beam holds of it
// goes to and fro.  Points on bearings half a beam apart, the same for every sector, to
// kBridgeReach; at most kMostBridges walls. Error: land before a bridge does not hide it here; both
// legs are taken as equally long.
inline constexpr double kBridgeReach = 1000.0;  // metres
inline constexpr std::size_t kMostBridges = 16;
void add_bridge_echoes(const RadarModel& model, const Scene& scene, const SpokeAim& aim,
                       const BearingSpan& where, std::vector<PointEcho>& out);

}  // namespace skerry::echo
