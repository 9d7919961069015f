// The native protocol in binary WebSocket messages, for browsers.
#pragma once

#include <memory>

#include "server/net/common/peer_stream.hpp"
#include "server/net/native/byte_transport.hpp"

namespace skerry::server {

// Requires a stream whose WebSocket handshake is done.
std::unique_ptr<ByteTransport> make_ws_transport(std::unique_ptr<WsStream> stream);

}  // namespace skerry::server
