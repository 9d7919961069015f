// The text of a new scenario.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// "open", "fairway", "anchorage".
std::vector<std::string> scenario_templates();

// A commented scenario around a place, that loads.  Nothing if there is no such template.
std::optional<std::string> new_scenario(const std::string& scheme, const std::string& name,
                                        GeoPoint place);

}  // namespace skerry::server
