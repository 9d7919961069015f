// ByteTransport: what the native protocol needs of a connection, TCP or WebSocket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/net/common/asio.hpp"

namespace skerry::server {

// Bytes in both ways.  At most one read and one write are in flight; buffers live until their
// handler was called.  No handler is called from within the function that it was given to.
// Thread: net-0.
class ByteTransport {
 public:
  using Done = std::function<void(error_code, std::size_t)>;
  virtual ~ByteTransport() = default;

  // Error: errc::bad_message for data of a kind that carries no frames (a WebSocket text message).
  virtual void read_some(std::span<std::uint8_t> into, Done done) = 0;
  // Writes all of `buffers`, whole frames, without copying them.
  virtual void write(const std::vector<asio::const_buffer>& buffers, Done done) = 0;
  // Writes what of `buffers` the kernel has room for at once, without waiting: the bytes of it,
  // from the first on.  0 where a transport cannot, or the connection is broken: write() tells.
  virtual std::size_t write_now(const std::vector<asio::const_buffer>& /*buffers*/) { return 0; }
  // Tells the peer that nothing more will come.  Requires no write in flight; the peer answers by
  // ending its side, which ends the read with an error.
  virtual void finish() = 0;
  // Ends the connection at once; what is in flight ends with an error.
  virtual void close() = 0;
  // Bytes that may wait in the kernel for a peer that does not read.
  virtual void limit_send_buffer(std::size_t bytes) = 0;

  virtual std::string name() const = 0;  // "tcp", "websocket"
};

}  // namespace skerry::server
