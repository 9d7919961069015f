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

// Nothing, if the options name no fleet.  Otherwise returns when the exercise's time is known, or
// `is_to_end`, which waits for so long, says that the server ends: then its time() is not known.
// `scenario`: its text, which all hosts must have alike, as they must have the charts.
// Error: std::runtime_error, the exercise of that name is another, or the store refuses this host.
std::unique_ptr<FleetHost> join_fleet(
    const Options& options, RadarServer& radars, const NetServer& net, const std::string& scenario,
    const std::function<bool(std::chrono::milliseconds)>& is_to_end);

}  // namespace skerry::server
