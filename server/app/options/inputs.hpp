// Inputs: from the configuration to own ships' motion and real radars.
#pragma once

#include <vector>

#include "server/app/config.pb.h"
#include "server/live/live_source.hpp"
#include "server/net/common/net_config.hpp"

namespace skerry::server {

// Adds those that move own ships.
// Error: std::runtime_error naming the entry, the key, and what was expected; also for a key that
// its kind does not take.
void add_inputs(const app::ServerConfig& file, NetConfig& net);

// Those that are real radars.
// Error: as above; also where two are of one radar, or one would hear an output of this server.
std::vector<LiveSource> live_sources(const app::ServerConfig& file);

}  // namespace skerry::server
