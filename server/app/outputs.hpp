// Outputs and inputs: from the configuration file or the command line to the network's own terms.
#pragma once

#include <string>

#include "server/app/config.pb.h"
#include "server/net/common/net_config.hpp"

namespace skerry::server {

// "KIND" or "KIND:key=value,key=value": the keys of an entry of `outputs` or `inputs` in
// config.proto, a list's key once for each of its values.
// Error: ConfigError or std::runtime_error naming the text, what is wrong and what was expected.
app::Output parse_output(const std::string& text);
app::Input parse_input(const std::string& text);

// Adds the outputs of `file` to `net`, streams, emulated radars and sentences each to their own
// list.  Keys that are not of its kind are refused.
// Error: std::runtime_error naming the entry, the key, and what was expected.
void add_outputs(const app::ServerConfig& file, NetConfig& net);
void add_inputs(const app::ServerConfig& file, NetConfig& net);

}  // namespace skerry::server
