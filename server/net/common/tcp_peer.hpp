// Socket options and peer of TCP and WebSocket connections.
#pragma once

#include <span>
#include <string>

#include "protocol/quantity/time.hpp"
#include "server/net/common/asio.hpp"
#include "server/net/common/peer_net.hpp"

namespace skerry::server {

struct TcpPeer {
  std::string text = "unknown";
  PeerNet net;
  bool on_own_host = false;  // needs no token
  bool is_secure = false;    // the connection is encrypted
  // SHA-256 of the client's certificate, which has been verified; empty: it has shown none.
  std::string certificate = {};
  UtcTime certificate_ends = UtcTime::max();  // it, or its authority's
};

// An IPv4 address that came in over an IPv6 socket counts as the IPv4 address it is.
bool is_loopback(const asio::ip::address& address);

// Who is at the other end; a connection that is already gone is "unknown" and not on this host.
// `foreign`: NetConfig::foreign_addresses.
TcpPeer peer_of(const TcpSocket& socket, std::span<const std::string> foreign);
// The same without a socket.
TcpPeer peer_at(const asio::ip::tcp::endpoint& endpoint, std::span<const std::string> foreign);

// No delay for small messages, and keep-alive probes, so that a peer that vanished without a word
// is noticed after about a minute of silence.
void set_stream_options(TcpSocket& socket);

void set_send_buffer(TcpSocket& socket, std::size_t bytes);

}  // namespace skerry::server
