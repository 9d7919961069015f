// Streams of datagrams in shapes of their own.
#pragma once

#include <cstddef>
#include <memory>

#include "server/net/common/net_context.hpp"
#include "server/net/outputs/udp_sender.hpp"

namespace skerry::server {

// The sender of context.config.streams[number].  Adds the stream's format to the view that it
// shows, and opens that view if it is one of its own.  Call it before the radars start.
// Error: std::runtime_error naming the destination and the reason: no such radar or board, no view
// left, a shape that the protocol does not have, as UdpSender's.
std::unique_ptr<UdpSender> open_stream(NetContext& context, std::size_t number);

}  // namespace skerry::server
