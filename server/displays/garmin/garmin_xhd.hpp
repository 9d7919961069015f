// A Garmin xHD radar as chart plotters and OpenCPN meet it on the network.
#pragma once

#include <memory>

#include "protocol/garmin/xhd_packet.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// The addresses are fixed in the displays; others are for tests, and for displays told of them.
// The durations are a real scanner's (garminxhd_txon_txoff.pcap.gz): the picture begins when it has
// spun up, and ends at once.
struct GarminOptions {
  Ipv4Endpoint reports = garmin::kReportAddress;
  Ipv4Endpoint spokes = garmin::kSpokeAddress;
  Ipv4Endpoint heartbeat = garmin::kHeartbeatAddress;
  std::uint16_t command_port = garmin::kCommandPort;
  Duration starting = std::chrono::milliseconds(3250);
  Duration spinning_up = std::chrono::milliseconds(2100);
  Duration stopping = std::chrono::milliseconds(1910);
  Duration spinning_down = std::chrono::milliseconds(2100);  // its end is not in the capture
};

std::unique_ptr<RadarEmulation> make_garmin_xhd(const GarminOptions& options);
EmulationIdentity identity_of(const GarminOptions& options);

}  // namespace skerry::server
