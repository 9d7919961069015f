// The faults of an own ship's radars.
#pragma once

#include <cstdint>

#include "echo/artefacts/radar_faults.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// A blackout loses the trigger too.  The bearing error is the scene's (SceneBuilder), lost spokes
// are those of loses_spoke().
echo::RadarFaults radar_faults(const ShipState& own_ship);

// Whether spoke `n` from the antenna's start comes empty: by the share lost, drawn by seed, radar
// and number; all of them in a blackout.
bool loses_spoke(const ShipState& own_ship, std::uint64_t seed, std::uint32_t radar,
                 std::uint64_t n);

}  // namespace skerry::server
