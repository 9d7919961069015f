// What must hold in a scenario beyond what the schema can say.
#pragma once

#include "server/config/yaml_source.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Checks `scenario` and fills in what the schema cannot: names of radars, sizes of target kinds.
// Error: ConfigError as of load_scenario().
void check_scenario(const YamlSource& source, scenario::Scenario& scenario);

}  // namespace skerry::server
