// --waypoint of the commands that order ships.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/exercise.pb.h"

namespace skerry::client {

// --waypoint LATITUDE,LONGITUDE[,NAME=VALUE...], as often as wanted; names are those of Waypoint's
// other fields.  `texts` must outlive the command.
void add_waypoint_option(CLI::App& command, std::vector<std::string>& texts);

// What is wrong with the text, if anything is.
std::optional<std::string> read_waypoint(const std::string& text, wire::Waypoint& waypoint);

}  // namespace skerry::client
