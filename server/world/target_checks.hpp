// What a scenario's targets must hold.
#pragma once

#include <string>

#include "server/config/yaml_message.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Refuses what contradicts itself among the targets, and sets what the file does not give: sizes of
// the kind or of the class.  Then the groups of traffic become targets (traffic_groups.hpp).
void check_targets(scenario::Scenario& scenario, YamlSource& source);

// Refuses a ship, own or not, that is broader than long.
void check_hull(const scenario::OwnShip& ship, const std::string& path, YamlSource& source);
void check_hull(const scenario::Target& ship, const std::string& path, YamlSource& source);

}  // namespace skerry::server
