// An instructor's change of the environment, and what consoles are told of it.
#pragma once

#include <optional>

#include "protocol/wire/radar.pb.h"
#include "server/world/environment.hpp"

namespace skerry::server {

// Changes `environment` as of `now`; a cell whose drift changes goes on from where it is then.
// Requires numbers that refusal_of() lets through.  Gives the reply that refuses the change (no
// such rain cell, no place for a new one, too many), and then `environment` may be half changed.
std::optional<wire::Reply> change_environment(const wire::WorldChange& change, ScenarioTime now,
                                              Environment& environment);

// The environment, its rain where it is at that time.
wire::World world_message(const Environment& environment, ScenarioTime now);

}  // namespace skerry::server
