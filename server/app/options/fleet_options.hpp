// Options of a host of a fleet.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}
namespace skerry::app {
class Fleet;
class ServerConfig;
}  // namespace skerry::app

namespace skerry::server {

struct NetConfig;

struct FleetOptions {
  std::vector<std::string> store;  // "192.0.2.1:2379" each; none: this server runs alone
  std::string exercise = "exercise";
  std::string host;     // this host's name
  std::string address;  // by which others reach it
  std::string tls;      // folder; empty: the store is reached in the clear
};

// --fleet and what belongs to it; `line` must outlive the parsing.
void add_fleet_options(CLI::App& cli, app::Fleet& line);

// Error: std::runtime_error for what is no member or no name, and what a fleet cannot do.
FleetOptions fleet_options(const app::ServerConfig& config, const NetConfig& net);

}  // namespace skerry::server
