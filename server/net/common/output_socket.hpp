// The sockets of an emulated radar: each bound to one interface of this host and to nothing else.
#pragma once

#include "server/displays/radar_emulation.hpp"
#include "server/net/common/asio.hpp"

namespace skerry::server {

// A turn's burst of the largest frames many times, and the burst of a sector of the longest spokes
// (16 times 4.3 kB) several times over.
inline constexpr int kDatagramSendBuffer = 1024 * 1024;

// Requires an IPv4 endpoint.
Ipv4Endpoint ipv4_endpoint_of(const asio::ip::udp::endpoint& endpoint);

// Sends from `interface_address`, unicast and multicast, with that TTL; what this host itself has
// joined hears it, too.
// Error: std::runtime_error saying what failed and why.
UdpSocket open_sending(asio::io_context& io, const asio::ip::address_v4& interface_address,
                       int ttl);

// Hears what comes to `listen.at`: of a group, only what comes in by that interface, whoever else
// has joined it there or elsewhere; otherwise what comes to that address, or to the interface's if
// it is 0.  Many sockets may listen to one group, and only one to any other address and port.
// Error: std::runtime_error saying what failed and why.
UdpSocket open_listening(asio::io_context& io, const EmulationListen& listen,
                         const asio::ip::address_v4& interface_address);

// The system's number of the interface that has the address; 0 if none has, and for 127.0.0.0/8,
// whose addresses are told apart by sender (DisplayOutput).
unsigned interface_of(const asio::ip::address_v4& address);

}  // namespace skerry::server
