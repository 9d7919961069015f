// What a scenario says of its coast, as the echo takes it.
#pragma once

#include "echo/scene/coast_rules.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Error: std::runtime_error naming the key ("coast.rocky") and what is allowed.
echo::CoastRules coast_rules(const scenario::Scenario& scenario);

}  // namespace skerry::server
