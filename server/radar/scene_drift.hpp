// Drift in a scene: weather, and things that the sea carries.
#pragma once

#include <cstdint>

#include "echo/chart/local_plane.hpp"
#include "echo/scene/scene.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Air, sea, waves, artefact switches and rain.  Requires scene.own_ship_geo and own_ship.
void lay_weather(const WorldState& state, const echo::LocalPlane& plane, double reach_m,
                 std::uint64_t seed, echo::Scene& scene);

// Small targets that make way, and SARTs, those of ships among them.
void lay_drifting(const WorldState& state, const echo::LocalPlane& plane, double reach_m,
                  std::uint64_t seed, echo::Scene& scene);

}  // namespace skerry::server
