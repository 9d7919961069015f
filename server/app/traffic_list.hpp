// The ships and marks of the world, as AIS and tracking are told of them.
#pragma once

#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/core/traffic.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Own ships first, in their order, then targets, then racons, where they are `now`, which lies
// within the state's tick.  Numbered in that order, so that a number stays the same.
std::vector<TrafficItem> traffic_of(const WorldState& state, ScenarioTime now);

}  // namespace skerry::server
