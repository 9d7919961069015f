// The coast settings of a scenario, in the form that the echo takes.
#pragma once

#include "echo/scene/coast_rules.hpp"
#include "server/config/config_error.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Error: std::runtime_error naming the key ("coast.rocky") and what is allowed.
echo::CoastRules coast_rules(const scenario::Scenario& scenario);

// Adds every style that cannot be to the errors of the scenario's file.
void check_coast(const scenario::Scenario& scenario, YamlSource& source);

}  // namespace skerry::server
