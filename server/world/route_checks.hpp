// What a scenario's routes must hold.
#pragma once

#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/length.hpp"
#include "server/config/yaml_message.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Along the geodesic.
Length distance_between(GeoPoint from, GeoPoint to);

// Whether a leg may be so long.
bool is_leg(Length length);
// Refuses a leg that is shorter than 1 m or longer than 5000 NM: beyond that two places come near
// to being antipodes, between which the way is arbitrary.  `path` is that of `to`.
void check_leg(GeoPoint from, GeoPoint to, const std::string& path, YamlSource& source);

// Refuses a class that there is not, and what does not go with one.  Sizes that the file does not
// give become those of the class.
void check_ship_class(scenario::OwnShip& ship, const std::string& path, YamlSource& source);

}  // namespace skerry::server
