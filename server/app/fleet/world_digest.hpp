// world_digest: by which hosts see that they have the same world.
#pragma once

#include "server/fleet/world_hashes.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// SHA-256 of all that moves and of the clocks, bit for bit: times, own ships with their con, ships
// and small targets, rain, the water's level, and how many orders the exercise has had.
fleet::WorldDigest world_digest(const WorldState& state);

}  // namespace skerry::server
