// An instructor's change of the environment, and what consoles are told of it.
#pragma once

#include <optional>

#include "protocol/wire/radar.pb.h"
#include "server/world/environment.hpp"

namespace skerry::server {

// Changes `environment` as of `now`, on the exercise's clock; a cell whose drift changes goes on
// from where it is then. Requires numbers that refusal_of() lets through.  Gives the reply that
// refuses the change (no such rain cell, no place for a new one, too many), and then `environment`
// may be half changed.
std::optional<wire::Reply> change_environment(const wire::WorldChange& change, Duration now,
                                              Environment& environment);

// The environment, its rain where it is at that time of the exercise.  scenario_s is that time too.
wire::World world_message(const Environment& environment, Duration now);

}  // namespace skerry::server
