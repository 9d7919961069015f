// join_fleet: a server takes its place in a fleet before its radars turn.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/app/fleet/fleet_host.hpp"
#include "server/app/options/options.hpp"
#include "server/net/net_server.hpp"

namespace skerry::server {

struct JoinedFleet {
  std::unique_ptr<FleetHost> host;  // null: the options name no fleet
  Duration time{};                  // of the exercise; 0 of one that runs alone
  bool ends = false;                // the server is to end before the time was known
};

// Returns when the exercise's time is known, or `is_to_end`, which waits for so long, says that the
// server ends.
// `scenario`: its text, which all hosts must have alike, as they must have the charts.
// Error: std::runtime_error, the exercise of that name is another, or the store refuses this host.
JoinedFleet join_fleet(const Options& options, RadarServer& radars, const NetServer& net,
                       const std::string& scenario,
                       const std::function<bool(std::chrono::milliseconds)>& is_to_end);

}  // namespace skerry::server
