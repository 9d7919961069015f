// Options of a command that fill a message: one for each field, from the schema.
#pragma once

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/wire/schema.hpp"

namespace skerry::client {

// One option for each number, switch, choice and text of `message` that is not `left_out`.
// `message` must outlive the command.
void add_message_options(CLI::App& command, wire::Message& message,
                         std::initializer_list<std::string_view> left_out = {});

// Nothing if the text is no number, or no finite one.
std::optional<double> finite_number(const std::string& text);

}  // namespace skerry::client
