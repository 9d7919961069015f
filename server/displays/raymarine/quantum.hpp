// A Raymarine Quantum radar as multifunction displays and OpenCPN meet it on the network.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "protocol/raymarine/quantum_locator.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// Only the group of the locator is fixed; the rest is told there, so that several radars can stand
// on one network if their link ids, data groups and serial numbers differ.
struct QuantumOptions {
  Ipv4Endpoint locator = raymarine::kLocatorAddress;
  Ipv4Endpoint data{ipv4(232, 1, 215, 1), 2574};
  std::uint16_t command_port = 2575;      // 0: any free one
  std::uint32_t link_id = 0x534B0001;     // the locator's packets of one radar share it
  std::string part_number = "E70498";     // at most 6 characters; E70498: Quantum 2 with Doppler
  std::string serial_number = "0000001";  // at most 7 characters
  // To standby when no display has sent anything for so long; nothing: never.
  std::optional<Duration> standby_after;
};

std::unique_ptr<RadarEmulation> make_quantum(const QuantumOptions& options);
EmulationIdentity identity_of(const QuantumOptions& options);

}  // namespace skerry::server
