// What sort of ship one is by her AIS: class of traffic and type of the scenario.
#pragma once

#include <string_view>

#include "server/traffic_logs/heard_ship.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// A key of traffic/traffic_class.hpp, by type, then by length: of cargo ships, tankers, passenger
// ships and fast craft the class nearest in length.  Who says neither is a coaster, or a yacht in
// class B.
std::string_view traffic_class_of(const HeardIdentity& ship);

// The scenario's type for that of AIS: 71 (hazardous cargo) is cargo; type_not_given if the number
// says nothing.
scenario::ShipType ship_type_of(unsigned ais_type);

}  // namespace skerry::server
