// Who in a scenario is on land, or sails over it.
#pragma once

#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// What is wrong, one line each, as "targets[3] (Lyngen): ...":
// - own ships, targets that are ships or craft, SARTs that begin on land;
// - legs of routes over land, looked at every 50 m;
// - ships that come on land within `minutes` when nobody touches them, looked at every 10 s.
// Land is that of the chart, not refined.  Requires a checked scenario.
std::vector<std::string> land_complaints(const scenario::Scenario& scenario,
                                         const echo::ChartSource& chart, double minutes);

}  // namespace skerry::server
