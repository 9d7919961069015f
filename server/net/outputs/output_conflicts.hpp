// Whether emulated radars can stand on one host beside each other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/ipv4_endpoint.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// An address or identity that an output takes for itself.
struct OutputClaim {
  std::string name;  // "output 2 (navico_br24, radar 0)"
  std::string interface_address;
  unsigned interface = 0;  // interface_of() that address
  EmulationIdentity identity;
  std::vector<Ipv4Endpoint> groups;  // that it listens to
};

// Why two of them cannot be: what they share, and what to do.  Those that share a fixed address
// need interface addresses of their own, and where that address is a group in which displays
// command, interfaces of their own.
std::optional<std::string> conflict_among(std::span<const OutputClaim> claims);

}  // namespace skerry::server
