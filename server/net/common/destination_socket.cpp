#include "server/net/common/destination_socket.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <cerrno>
#include <stdexcept>

#include "protocol/wire/datagram.hpp"
#include "server/net/common/output_socket.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

void check_destination(const UdpDestination& to, std::string_view stream) {
  if (to.port == 0) fail_destination(to, stream, "the port must be 1 to 65535");
  if (to.multicast_ttl < 0 || to.multicast_ttl > 255) {
    fail_destination(to, stream, fmt::format("multicast TTL {} is not 0 to 255", to.multicast_ttl));
  }
  if (to.max_datagram != 0 && (to.max_datagram < kMinDatagram || to.max_datagram > kMaxDatagram)) {
    fail_destination(to, stream,
                     fmt::format("a largest datagram of {} bytes is not 0 or {} to {}",
                                 to.max_datagram, kMinDatagram, kMaxDatagram));
  }
}

}  // namespace

DestinationSocket open_destination(asio::io_context& io, const UdpDestination& to,
                                   std::string_view stream) {
  check_destination(to, stream);
  error_code error;
  const auto address = asio::ip::make_address(to.address, error);
  if (error) fail_destination(to, stream, "the address must be an IPv4 or IPv6 literal");
  DestinationSocket out{UdpSocket(io), {address, to.port}};
  const auto check = [&](const char* what) {
    if (error) fail_destination(to, stream, fmt::format("{}: {}", what, error.message()));
  };
  out.socket.open(out.endpoint.protocol(), error);
  check("cannot open a socket");
  out.socket.set_option(asio::socket_base::send_buffer_size(kDatagramSendBuffer), error);
  check("cannot set the send buffer");
  if (!address.is_multicast()) return out;
  out.socket.set_option(asio::ip::multicast::hops(to.multicast_ttl), error);
  check("cannot set the multicast TTL");
  if (to.interface_address.empty()) return out;
  const auto interface = asio::ip::make_address_v4(to.interface_address, error);
  check("the interface must be given by its IPv4 address");
  out.socket.set_option(asio::ip::multicast::outbound_interface(interface), error);
  check("cannot send from that interface");
  return out;
}

void fail_destination(const UdpDestination& to, std::string_view stream, std::string_view reason) {
  throw std::runtime_error(fmt::format("{} datagrams of radar {} to {} port {}: {}", stream,
                                       to.radar, to.address, to.port, reason));
}

void check_radar(RadarHost& host, const UdpDestination& to, std::string_view stream) {
  if (host.find_channel(to.radar, 0) != nullptr) return;
  fail_destination(
      to, stream,
      fmt::format("there is no such radar; there are {}, counted from 0", host.radar_count()));
}

std::size_t longest_datagram(const UdpDestination& to) {
  if (to.max_datagram != 0) return to.max_datagram;
  error_code error;
  const auto address = asio::ip::make_address(to.address, error);
  return !error && is_loopback(address) ? kMaxDatagram : kDefaultDatagram;
}

int send_at_once(UdpSocket& socket, const asio::ip::udp::endpoint& to,
                 std::span<const std::uint8_t> bytes) {
  const auto sent =
      ::sendto(socket.native_handle(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
               to.data(), static_cast<socklen_t>(to.size()));
  return sent >= 0 ? 0 : errno;
}

}  // namespace skerry::server
