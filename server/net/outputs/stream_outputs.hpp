// Streams of datagrams in shapes of their own.
#pragma once

#include <cstddef>

#include "server/net/common/net_context.hpp"
#include "server/net/outputs/udp_sender.hpp"

namespace skerry::server {

// Adds the stream's format to the view it shows, which it opens if it is one of its own, and says
// what a UdpSender needs to know of it.  `number`: of the stream in the configuration, from 0.
// Before the radars start.  Error: std::runtime_error naming the stream and the reason: no such
// radar, no view left, a shape that the protocol does not have.
UdpStream open_stream(NetContext& context, const StreamOutputConfig& config, std::size_t number);

}  // namespace skerry::server
