// What a plotter is told of own ship and of AIS, from what the server tells everybody.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/wire/own_ship.pb.h"
#include "server/core/traffic.hpp"
#include "server/tracking/watch/target_watch.hpp"

namespace skerry::server {

// What her sensors say; what is lost is absent.  Water is moved through along the heading, or as
// the log of a ship that has a class says, athwart too.
OwnSensors sensors_of(const wire::OwnShip& ship);

// Ships within kAisReach of own ship whose AIS is on, as they tell of themselves at this moment;
// none if own ship hears none.  Those that carry `radar` are own ship.
inline constexpr double kAisReach_m = 40.0 * 1852.0;  // where VHF ends; assumed
std::vector<AisContact> ais_contacts(std::span<const TrafficItem> traffic,
                                     const wire::OwnShip& own_ship, std::uint32_t radar);

}  // namespace skerry::server
