// SignalkConfig: what the server offers to Signal K displays.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/signalk/documents.hpp"

namespace skerry::server {

struct SignalkConfig {
  bool serve = true;  // beside the web console, on the HTTP port
  signalk::Dialect dialect = signalk::Dialect::current;
  // Tells other hosts by mDNS, through the system's Avahi, that it is there; only if the server is
  // bound to more than loopback.
  bool advertise = true;
  // A Signal K server has one own ship.  That of radar 0 is at the HTTP port; others get a port of
  // their own.
  struct Ship {
    std::uint32_t radar = 0;  // one of her radars
    std::uint16_t port = 0;   // HTTP; 0: any free one
  };
  std::vector<Ship> further_ships;
};

}  // namespace skerry::server
