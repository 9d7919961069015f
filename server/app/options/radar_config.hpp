// From a scenario's radar to the unit that turns it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "server/config/config_error.hpp"
#include "server/radar/radar_unit.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

RadarConfig radar_config(const scenario::Radar& radar, std::uint32_t index, std::size_t own_ship,
                         std::uint64_t seed);

// Adds every locked name that is no control to the errors of the scenario's file.
void check_locks(const scenario::Scenario& scenario, YamlSource& source);

// The controls that are locked from the start, of each radar.
// Error: std::runtime_error naming the key and what is no control.
std::vector<std::vector<std::string>> initial_locks(const scenario::Scenario& scenario);

}  // namespace skerry::server
