// The scenario: what sails where, and which radars look at it (scenario.proto).
#pragma once

#include <string>

#include "server/config/config_error.hpp"
#include "server/config/yaml_tree.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

inline constexpr int kMaxOwnShips = 64;
inline constexpr int kMaxRadars = 64;          // of all own ships together
inline constexpr int kMaxTargets = 1000;       // ships
inline constexpr int kMaxSmallTargets = 4000;  // buoys, craft, markers, reflectors
inline constexpr int kMaxEmitters = 64;        // ships with a radar of their own
inline constexpr int kMaxRainCells = 64;
inline constexpr int kMaxWindTurbines = 1000;
inline constexpr int kMaxCables = 200;
inline constexpr int kMaxRacons = 200;
inline constexpr int kMaxSarts = 64;
inline constexpr int kMaxPulses = 16;  // of a radar, as of any set (echo/radar/set_checks.cpp)
inline constexpr int kMaxObstructions = 16;
inline constexpr int kMaxBlankedSectors = 8;
inline constexpr int kMaxWaypoints = 1000;  // of a target
inline constexpr int kMaxCoastPlaces = 1000;

// The scenario of a YAML text, defaults filled in.  Beyond the schema it must hold that
// - there is no more of anything than the limits above, and at least one radar;
// - own ships differ in name, and so do all radars; a radar without a name is called after its ship
//   and its number aboard: "Frida 1";
// - a radar's set is a shipped one and, as altered, passes its checks (radar_sets.hpp);
// - a radar's board has no contradiction (board_registers.hpp), and its channels' sources are
//   radars of the same ship;
// - no ship is broader than long;
// - a target has only keys of its kind; a reflector stands still;
// - no two MMSI are the same; what has none gets one (ais_identities.hpp);
// - the exercise's sheet names what is there (exercise_sheet.hpp);
// - it includes no other file: that is for load_scenario();
// - a racon's code is 1 to 4 letters, it is on for at most its period and on one band or both;
// - a cable is 1 m to 20 km long;
// - a target with waypoints has a speed, no course, and legs of 1 m to 5000 NM.
// Whether anything lies ashore is not looked at.
// Error: ConfigError with all that is wrong, each with file, line, column, key, value and what is
// allowed; messages call the text `file_name`.
scenario::Scenario parse_scenario(const std::string& text, const std::string& file_name);

// parse_scenario() of a file and of those that it includes.
scenario::Scenario load_scenario(const std::string& path);

// The same for those who check more: all that is wrong goes to `source`, and what could be read is
// returned.  Error: ConfigError as read_yaml().
scenario::Scenario read_scenario(const std::string& text, YamlSource& source);
scenario::Scenario read_scenario(const YamlNode& root, YamlSource& source);

// scenarios/bergen.yaml as built into the program, and what it says.
const std::string& default_scenario_yaml();
scenario::Scenario default_scenario();

}  // namespace skerry::server
