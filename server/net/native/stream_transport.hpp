// The native protocol straight on TCP, plain or under TLS.
#pragma once

#include <memory>

#include "server/net/common/peer_stream.hpp"
#include "server/net/native/byte_transport.hpp"

namespace skerry::server {

// Requires of a secure stream that its handshake is done.
std::unique_ptr<ByteTransport> make_stream_transport(PeerStream stream);

}  // namespace skerry::server
