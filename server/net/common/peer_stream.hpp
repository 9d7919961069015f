// PeerStream: one client's connection, plain or under TLS.
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "server/net/common/asio.hpp"

namespace skerry::server {

// What an HTTP or WebSocket session needs of beast::basic_stream, whose rules it has: at most one
// read and one write are in flight, and a time limit ends both and closes.
// Thread: net-0.
class PeerStream {
 public:
  using executor_type = NetExecutor;
  using Tls = asio::ssl::stream<TcpStream&>;

  explicit PeerStream(TcpSocket socket) : tcp_(std::make_unique<TcpStream>(std::move(socket))) {}

  // From now on what is read and written goes through TLS; async_handshake() first.
  void begin_tls(asio::ssl::context& keys) { tls_ = std::make_unique<Tls>(*tcp_, keys); }
  template <typename Handler>
  void async_handshake(Handler&& handler) {
    tls_->async_handshake(asio::ssl::stream_base::server, std::forward<Handler>(handler));
  }
  bool is_secure() const { return tls_ != nullptr; }

  executor_type get_executor() { return tcp_->get_executor(); }
  TcpSocket& socket() { return tcp_->socket(); }
  const TcpSocket& socket() const { return tcp_->socket(); }
  void expires_after(std::chrono::nanoseconds time) { tcp_->expires_after(time); }
  void expires_never() { tcp_->expires_never(); }
  void cancel() { tcp_->cancel(); }
  void close() { tcp_->close(); }
  // Tells the peer that nothing more will come.  Requires no write in flight.
  void finish() {
    if (tls_) return tls_->async_shutdown([](error_code) {});
    error_code ignored;
    socket().shutdown(asio::socket_base::shutdown_send, ignored);
  }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_read_some(buffers, std::forward<Handler>(handler));
    } else {
      tcp_->async_read_some(buffers, std::forward<Handler>(handler));
    }
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_write_some(buffers, std::forward<Handler>(handler));
    } else {
      tcp_->async_write_some(buffers, std::forward<Handler>(handler));
    }
  }

  // What Beast asks of a stream under a WebSocket, whose own closing handshake says already that
  // nothing was cut off.
  friend void beast_close_socket(PeerStream& stream) { stream.close(); }
  friend void teardown(beast::role_type role, PeerStream& stream, error_code& error) {
    websocket::teardown(role, stream.socket(), error);
  }
  template <typename Handler>
  friend void async_teardown(beast::role_type role, PeerStream& stream, Handler&& handler) {
    websocket::async_teardown(role, stream.socket(), std::forward<Handler>(handler));
  }

 private:
  std::unique_ptr<TcpStream> tcp_;  // where tls_ finds it, wherever this moves
  std::unique_ptr<Tls> tls_;
};

using WsStream = websocket::stream<PeerStream>;

}  // namespace skerry::server
