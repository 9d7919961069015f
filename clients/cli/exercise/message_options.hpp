// Options of a command that fill a message: one for each field, from the schema.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/wire/exercise.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::client {

// One option for each number, switch, choice and text of `message` that is not `left_out`.
// `message` must outlive the command.
void add_message_options(CLI::App& command, wire::Message& message, std::string_view left_out = {});

// --waypoint LATITUDE,LONGITUDE[,NAME=VALUE...], as often as wanted; names are those of Waypoint's
// other fields.  `texts` must outlive the command.
void add_waypoint_option(CLI::App& command, std::vector<std::string>& texts);

// What is wrong with the text, if anything is.
std::optional<std::string> read_waypoint(const std::string& text, wire::Waypoint& waypoint);

}  // namespace skerry::client
