// What the files of tokens and of users have in common.
#pragma once

#include <string>
#include <string_view>

namespace skerry::server {

// A text in YAML's double quotes.
std::string in_quotes(std::string_view text);

// Error: std::invalid_argument unless the name has 1 to 64 bytes and the ship at most 64, of
// printable letters alone.  `what` is "token" or "user".
void require_entry(std::string_view what, std::string_view name, std::string_view ship);

}  // namespace skerry::server
