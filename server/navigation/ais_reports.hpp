// AIS reports of a ship or mark, and how often each is sent.
#pragma once

#include <optional>
#include <vector>

#include "protocol/nmea/ais_messages.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

// Message 1 of ships, 18 of boats, 21 of aids to navigation; nothing of what has no MMSI or is
// silent.  Ships say what their AIS is told by sensors aboard.
std::optional<nmea::AisMessage> position_report(const TrafficItem& item, UtcTime utc);
// Message 5 of ships, 24 A and B of boats.
std::vector<nmea::AisMessage> static_reports(const TrafficItem& item);

nmea::AisMessage own_position_report(const wire::OwnShip& ship, std::uint32_t mmsi);
nmea::AisMessage own_static_report(const wire::OwnShip& ship, std::uint32_t mmsi);

// Reporting intervals.  "Changing course" is a turn of more than 20 deg/min: then the heading is
// more than 5 deg from its mean over 30 s.  A ship that lies still counts as anchored.
// Source: ITU-R M.1371-5 annex 1 tables 1 and 2.
Duration position_interval(TrafficKind kind, double speed_mps, double rate_of_turn_deg_min);
inline constexpr Duration kStaticInterval = std::chrono::minutes(6);

}  // namespace skerry::server
