// NetConfig: addresses, ports and limits of the server's network side.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/signalk/documents.hpp"
#include "server/core/audit_port.hpp"
#include "server/navigation/ship_sensors.hpp"
#include "server/net/common/navigation_config.hpp"
#include "server/net/common/output_config.hpp"
#include "server/net/common/peer_limits.hpp"

namespace skerry::server {

// The server's offer to Signal K displays.
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

struct NetConfig {
  // Of this run of the server, by which relays know it again; empty: it tells none.
  std::string identity;
  std::string bind = "127.0.0.1";  // address for TCP and HTTP
  std::uint16_t tcp_port = 7410;   // native protocol; 0: any free port
  std::uint16_t http_port = 7480;  // HTTP and WebSocket; 0: any free port
  std::vector<StreamOutputConfig> streams;
  std::vector<TargetOutputConfig> target_outputs;
  std::vector<DisplayOutputConfig> displays;
  std::vector<NavigationOutputConfig> navigation_outputs;
  std::vector<NavigationInputConfig> navigation_inputs;
  // Of simulated own ships, in sentences and Signal K; of a playback none are added.
  SensorErrors sensors = SensorErrors::none();

  // The token that makes whoever has it an admin; empty: there is none.
  std::string control_token;
  // File of tokens (server/access/token_file.hpp); empty: none, and other hosts may look.
  std::string tokens;
  // File of users (server/access/user_file.hpp); empty: none, and nobody signs in by name.
  std::string users;
  // Folder with server.pem and server.key (server/tls/certificate.hpp); empty: nothing is
  // encrypted.
  std::string tls;
  // What guards it not, although other hosts may reach it (exposure_of()): for status and pages.
  std::string exposure;
  // Folder of consoles' set-ups (server/setups/setup_shelf.hpp); empty: browsers alone keep some.
  std::string setups;
  // Where it is kept who changed what; nullptr: nowhere.  Outlives the server.
  AuditPort* audit = nullptr;
  // Names, without port, by which browsers may address this server, besides localhost and, when
  // `bind` is no loopback address, any IP literal.
  std::vector<std::string> allowed_hosts;
  SignalkConfig signalk;
  std::string web_root;  // directory with the web console; empty: the one built in

  std::size_t max_connections = 256;  // TCP, HTTP and WebSocket together
  PeerLimits limits;
  // Addresses of loopback that count as other hosts: strangers for tests.
  std::vector<std::string> foreign_addresses;
  // A client that leaves a full queue of replies unread for so long is closed.
  std::chrono::milliseconds reply_timeout{10'000};
  // For one HTTP answer to be taken, and between two requests on a kept connection.
  std::chrono::milliseconds http_timeout{15'000};
};

// One file of the web console as built into the server.
struct WebFile {
  std::string_view path;  // "/index.html"
  std::string_view mime;  // "text/html; charset=utf-8"
  std::string_view body;
};

}  // namespace skerry::server
