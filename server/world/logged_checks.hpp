// What a scenario's ships must hold that sail as a log has them (key `as_logged`).
#pragma once

#include <string>

#include "server/config/yaml_message.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// More than any ship does, and more than two fixes a second apart say of one by their rounding.
inline constexpr double kMostLoggedSpeed_kn = 200.0;

// Refuses waypoints without a time, times that do not grow, legs faster than kMostLoggedSpeed_kn,
// and keys of ships that steer.
void check_logged(const scenario::Target& target, const std::string& path, YamlSource& source);

// Whether both are parts of the log of one ship: never on the water together.
bool are_parts_of_a_log(const scenario::Target& one, const scenario::Target& other);

}  // namespace skerry::server
