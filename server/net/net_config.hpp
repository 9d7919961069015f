// NetConfig: addresses, ports and limits of the server's network side.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/asterix/cat240.hpp"

namespace skerry::server {

// A receiver of datagrams: one radar's default view, or the records of its interface board, goes
// there for as long as the server runs.
struct UdpDestination {
  std::uint32_t radar = 0;
  std::string address = "127.0.0.1";  // IPv4 or IPv6 literal, unicast or multicast
  std::uint16_t port = 0;             // 1 .. 65535
  std::size_t max_datagram = 0;       // bytes; 0: 65507 on loopback, 1472 elsewhere
  int multicast_ttl = 0;              // 0 .. 255; 0: this host, 1: this network
  // Multicast: address of the interface to send from, empty: the system's choice.  IPv4 only.
  std::string interface_address = {};
};

struct NetConfig {
  std::string bind = "127.0.0.1";   // address for TCP and HTTP
  std::uint16_t tcp_port = 7410;    // native protocol; 0: any free port
  std::uint16_t http_port = 7480;   // HTTP and WebSocket; 0: any free port
  std::vector<UdpDestination> udp;  // native datagrams
  std::vector<UdpDestination> cat240 = {{.radar = 0, .address = "127.0.0.1", .port = 8600}};
  std::vector<UdpDestination> sweeps;  // records of interface boards, one in a body
  Cat240Source cat240_source;          // of radar 0; radar n has sic + n, modulo 256

  // What a Set message from elsewhere than this host must carry; empty: none is accepted from
  // there.
  std::string control_token;
  // Names, without port, by which browsers may address this server, besides localhost and, when
  // `bind` is no loopback address, any IP literal.
  std::vector<std::string> allowed_hosts;
  std::string web_root;  // directory with the web console; empty: the one built in

  std::size_t max_connections = 256;  // TCP, HTTP and WebSocket together
  // A client that leaves a full queue of replies unread for so long is closed.
  std::chrono::milliseconds reply_timeout{10'000};
  // For one HTTP request, and between two on a kept connection.
  std::chrono::milliseconds http_timeout{15'000};
};

// One file of the web console as built into the server.
struct WebFile {
  std::string_view path;  // "/index.html"
  std::string_view mime;  // "text/html; charset=utf-8"
  std::string_view body;
};

}  // namespace skerry::server
