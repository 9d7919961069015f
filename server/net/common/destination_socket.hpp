// Sockets that send the datagrams of one output to one address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "server/core/radar_host.hpp"
#include "server/net/common/asio.hpp"
#include "server/net/common/output_config.hpp"

namespace skerry::server {

struct DestinationSocket {
  UdpSocket socket;
  asio::ip::udp::endpoint endpoint;
};

// `stream` begins what is said of errors: "cat240".
// Error: std::runtime_error naming the stream, the destination and the reason: no literal address,
// a port, TTL or datagram size out of range, no such interface.
DestinationSocket open_destination(asio::io_context& io, const UdpDestination& to,
                                   std::string_view stream);

// Error: std::runtime_error, of those words.
[[noreturn]] void fail_destination(const UdpDestination& to, std::string_view stream,
                                   std::string_view reason);

// Error: of fail_destination(), if the radar of `to` is not there.
void check_radar(RadarHost& host, const UdpDestination& to, std::string_view stream);

// Bytes of the longest datagram; where that is left to the server: 65507 on loopback, 1472
// elsewhere.
std::size_t longest_datagram(const UdpDestination& to);

// Sends, or drops it at once.  Returns 0, or errno.
int send_at_once(UdpSocket& socket, const asio::ip::udp::endpoint& to,
                 std::span<const std::uint8_t> bytes);

}  // namespace skerry::server
