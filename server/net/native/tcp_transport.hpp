// TcpTransport: the native protocol straight on TCP.
#pragma once

#include <memory>

#include "server/net/native/byte_transport.hpp"

namespace skerry::server {

std::unique_ptr<ByteTransport> make_tcp_transport(TcpSocket socket);

}  // namespace skerry::server
