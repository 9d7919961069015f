// The scenario: what sails where, and which radars look at it (scenario.proto).
#pragma once

#include <string>

#include "server/world/scenario.pb.h"

namespace skerry::server {

inline constexpr int kMaxOwnShips = 64;
inline constexpr int kMaxRadarsPerOwnShip = 8;
inline constexpr int kMaxTargets = 1000;
inline constexpr int kMaxWaypoints = 1000;  // of a target
inline constexpr std::size_t kMaxNameBytes = 64;

// The scenario of a YAML file.  Beyond the schema: own ships have different names, so have the
// radars of an own ship (nameless ones become "radar 1", "radar 2" ... by their place in the list);
// no ship is wider than long; a target has either a course or waypoints; the limits above hold.
// Whether anything lies ashore is not looked at.
// Error: ConfigError naming file, line, column, key, value and what is allowed.
scenario::Scenario load_scenario(const std::string& path);

// The same from a text; messages call it `name`.
scenario::Scenario parse_scenario(const std::string& text, const std::string& name);

// scenarios/bergen.yaml as built into the program.
scenario::Scenario default_scenario();

}  // namespace skerry::server
