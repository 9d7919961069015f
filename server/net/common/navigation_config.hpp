// NavigationOutputConfig and NavigationInputConfig: where navigation data goes and comes from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "server/navigation/navigation_plan.hpp"

namespace skerry::server {

enum class NavigationTransport : std::uint8_t {
  udp,     // sentences in datagrams, all lines of a message in one
  tcp,     // a server: whoever connects gets, or sends, lines
  iec450,  // IEC 61162-450: datagrams that begin with "UdPbC" and lines with a TAG block
};

// Most plotters and OpenCPN listen there.
inline constexpr std::uint16_t kUsualNavigationPort = 10110;
// Connections of one input or output over TCP.
inline constexpr std::size_t kMostNavigationConnections = 64;

// Own ship of a radar and what is around her, as NMEA 0183.  Any number of outputs.
struct NavigationOutputConfig {
  std::uint32_t radar = 0;
  NavigationTransport transport = NavigationTransport::udp;
  // udp: where to; tcp: where to listen; iec450: where to, or empty: to the group of each sentence.
  // An IPv4 literal: unicast, multicast, or with `broadcast` a broadcast address.
  std::string address = "127.0.0.1";
  // 1 .. 65535; tcp: 0 any free one; iec450: used only with an address.
  std::uint16_t port = kUsualNavigationPort;
  bool broadcast = false;
  std::string interface_address = "127.0.0.1";  // to send multicast from
  int multicast_ttl = 0;                        // 0 .. 255; 0: this host, 1: this network
  std::string source = "RA0001";                // iec450: two letters and four digits
  std::size_t max_connections = 16;             // tcp: 1 .. kMostNavigationConnections
  NavigationPlan plan;
};

// An outside simulator that moves own ship of a radar by RMC, GGA, GLL, VTG, HDT, THS, VBW, VHW and
// ROT.  UDP and 61162-450 are told apart by the datagram itself.
struct NavigationInputConfig {
  std::uint32_t radar = 0;
  NavigationTransport transport = NavigationTransport::udp;
  std::string address = "127.0.0.1";            // to listen on; a multicast group is joined
  std::uint16_t port = 0;                       // 0: any free one
  std::string interface_address = "127.0.0.1";  // to join a group on
  // Who may: IPv4 literals or networks ("192.0.2.0/24"); empty: this host alone.
  std::vector<std::string> sources = {};
  std::size_t max_connections = 4;  // tcp: 1 .. kMostNavigationConnections
};

}  // namespace skerry::server
