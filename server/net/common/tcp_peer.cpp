#include "server/net/common/tcp_peer.hpp"

#include <netinet/tcp.h>

#include <algorithm>

#include "protocol/wire/host_and_port.hpp"

namespace skerry::server {
namespace {

using KeepIdle = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
using KeepInterval = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
using KeepCount = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPCNT>;

}  // namespace

bool is_loopback(const asio::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).is_loopback();
  }
  return address.is_loopback();
}

TcpPeer peer_of(const TcpSocket& socket, std::span<const std::string> foreign) {
  error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  return error ? TcpPeer{} : peer_at(endpoint, foreign);
}

TcpPeer peer_at(const asio::ip::tcp::endpoint& endpoint, std::span<const std::string> foreign) {
  const auto address = endpoint.address();
  const std::string text = address.to_string();
  const bool own =
      is_loopback(address) && std::find(foreign.begin(), foreign.end(), text) == foreign.end();
  return {host_and_port(text, endpoint.port()), own ? PeerNet::own_host() : PeerNet(address), own};
}

void set_stream_options(TcpSocket& socket) {
  error_code ignored;  // an option that cannot be set leaves a connection that still works
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  socket.set_option(KeepIdle(30), ignored);
  socket.set_option(KeepInterval(10), ignored);
  socket.set_option(KeepCount(3), ignored);
}

void set_send_buffer(TcpSocket& socket, std::size_t bytes) {
  error_code ignored;
  socket.set_option(asio::socket_base::send_buffer_size(static_cast<int>(bytes)), ignored);
}

}  // namespace skerry::server
