// A target that an instructor has made.
#pragma once

#include <optional>
#include <string>

#include "protocol/wire/exercise.pb.h"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// What is wrong with it: no such class, a name or a route too long, a speed beyond her class.
std::optional<std::string> fault_of(const wire::NewTarget& wanted);

// As a scenario would have it, with her class's sizes; without a name and an MMSI if none is given.
// Requires that fault_of() has none.
scenario::Target target_of(const wire::NewTarget& wanted);

}  // namespace skerry::server
