// Options of a relay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/relay/upstream_place.hpp"

namespace CLI {
class App;
}
namespace skerry::app {
class Relay;
class ServerConfig;
}  // namespace skerry::app

namespace skerry::server {

struct NetConfig;

struct RelayOptions {
  UpstreamPlace place;  // its host is empty: this server is no relay
  std::string token;    // of the other server; empty: none
  // Level of thin spokes, 0: none; nothing: as the link needs.
  std::optional<std::uint32_t> thin = 0;
};

// --relay and what belongs to it; `line` must outlive the parsing.
void add_relay_options(CLI::App& cli, app::Relay& line);

// Where it says no token file, the token is SKERRY_TOKEN of the environment, if there is one.
// Error: std::runtime_error for what is no server, a token file that cannot be read, and what a
// relay cannot do.
RelayOptions relay_options(const app::ServerConfig& config, const NetConfig& net);

}  // namespace skerry::server
