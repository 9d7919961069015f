// Outputs and inputs as the command line gives them.
#pragma once

#include <string>

#include "server/app/config.pb.h"

namespace skerry::server {

// "KIND" or "KIND:key=value,key=value": the keys of an entry of `outputs` or `inputs` in
// config.proto, a list's key once for each of its values.
// Error: ConfigError or std::runtime_error naming the text, what is wrong and what was expected.
app::Output parse_output(const std::string& text);
app::Input parse_input(const std::string& text);

// "[RADAR@]ADDRESS:PORT", an IPv6 address in brackets.
// Error: std::runtime_error naming the text and what was expected.
app::Destination parse_destination(const std::string& text);

}  // namespace skerry::server
