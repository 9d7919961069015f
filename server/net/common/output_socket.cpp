#include "server/net/common/output_socket.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "protocol/wire/host_and_port.hpp"

namespace skerry::server {
namespace {

constexpr int kReceiveBuffer = 1024 * 1024;  // of commands: what comes in between two looks

void require(const error_code& error, const std::string& what) {
  if (error) throw std::runtime_error(fmt::format("{}: {}", what, error.message()));
}

// Linux: no groups but those that this very socket has joined.
void hear_own_groups_only(UdpSocket& socket) {
  const int off = 0;
  if (::setsockopt(socket.native_handle(), IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off) != 0) {
    throw std::runtime_error(
        fmt::format("cannot choose multicast groups: {}", std::strerror(errno)));
  }
}

}  // namespace

Ipv4Endpoint ipv4_endpoint_of(const asio::ip::udp::endpoint& endpoint) {
  return {endpoint.address().to_v4().to_uint(), endpoint.port()};
}

UdpSocket open_sending(asio::io_context& io, const asio::ip::address_v4& interface_address,
                       int ttl) {
  UdpSocket socket(io);
  error_code error;
  socket.open(asio::ip::udp::v4(), error);
  require(error, "cannot open a socket");
  socket.set_option(asio::socket_base::send_buffer_size(kDatagramSendBuffer), error);
  require(error, "cannot set the send buffer");
  socket.bind({interface_address, 0}, error);
  require(error, fmt::format("cannot send from {}, which must be an address of this host",
                             interface_address.to_string()));
  socket.set_option(asio::ip::multicast::outbound_interface(interface_address), error);
  require(error, "cannot send to groups from that interface");
  socket.set_option(asio::ip::multicast::hops(ttl), error);
  require(error, "cannot set the multicast TTL");
  socket.set_option(asio::ip::multicast::enable_loopback(true), error);
  require(error, "cannot let this host hear its own groups");
  return socket;
}

UdpSocket open_listening(asio::io_context& io, const EmulationListen& listen,
                         const asio::ip::address_v4& interface_address) {
  const asio::ip::address_v4 wanted(listen.at.address);
  const bool group = listen.at.is_multicast();
  const asio::ip::udp::endpoint at(listen.at.address == 0 ? interface_address : wanted,
                                   listen.at.port);
  const std::string where = host_and_port(at.address().to_string(), at.port());
  UdpSocket socket(io);
  error_code error;
  socket.open(asio::ip::udp::v4(), error);
  require(error, "cannot open a socket");
  socket.set_option(asio::socket_base::receive_buffer_size(kReceiveBuffer), error);
  require(error, "cannot set the receive buffer");
  if (group) {
    socket.set_option(asio::ip::udp::socket::reuse_address(true), error);
    require(error, "cannot share " + where);
  }
  socket.bind(at, error);
  require(error, "cannot listen on " + where);
  if (group) {
    hear_own_groups_only(socket);
    socket.set_option(asio::ip::multicast::join_group(wanted, interface_address), error);
    require(error, fmt::format("cannot join {} on {}", where, interface_address.to_string()));
  }
  socket.non_blocking(true, error);
  require(error, "cannot make a socket non-blocking");
  return socket;
}

unsigned interface_of(const asio::ip::address_v4& address) {
  if (address.is_loopback()) return 0;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return 0;
  unsigned found = 0;
  for (const ifaddrs* one = all; one != nullptr && found == 0; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in its{};
    std::memcpy(&its, one->ifa_addr, sizeof its);
    if (ntohl(its.sin_addr.s_addr) == address.to_uint()) found = ::if_nametoindex(one->ifa_name);
  }
  ::freeifaddrs(all);
  return found;
}

}  // namespace skerry::server
