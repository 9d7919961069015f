// TlsOpening: a new connection, until it is known whether it is plain or under TLS.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "server/net/common/net_context.hpp"
#include "server/net/common/peer_stream.hpp"

namespace skerry::server {

// Where a connection goes once that is known.
struct OpeningTo {
  using Take = std::function<void(PeerStream, ConnectionSlotPtr)>;
  std::string protocol;  // for the log: "HTTP"
  Take secure;           // its handshake is done
  Take plain;            // it began with something else than TLS
  Take silent = {};      // it has said nothing for so long; empty: it is closed
  std::chrono::milliseconds patience{};
};

// Looks at the first byte, which stays where it is: 22 begins a TLS handshake (RFC 8446 5.1), and
// no HTTP request and no frame of the native protocol.  Ends a connection whose handshake fails, or
// is not done PeerLimits::opening_time after its first byte, or is one more than its peer may begin
// (NetContext::handshakes).
// Requires NetContext::tls.  Thread: net-0.
void open_connection(NetContext& context, TcpSocket socket, ConnectionSlotPtr slot, OpeningTo to);

}  // namespace skerry::server
