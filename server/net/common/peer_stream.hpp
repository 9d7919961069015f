// PeerStream: one client's connection, plain or under TLS.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "server/net/common/asio.hpp"

namespace skerry::server {

// A handler that keeps something alive until it has been called, and otherwise is as it was.
template <typename Kept, typename Handler>
struct Keeping {
  Kept kept;
  Handler handler;

  using allocator_type = asio::associated_allocator_t<Handler>;
  allocator_type get_allocator() const noexcept { return asio::get_associated_allocator(handler); }
  using executor_type = asio::associated_executor_t<Handler, NetExecutor>;
  executor_type get_executor() const noexcept {
    return asio::get_associated_executor(handler, kept->tcp.get_executor());
  }
  template <typename... Results>
  void operator()(Results&&... results) {
    handler(std::forward<Results>(results)...);
  }
};

// What an HTTP or WebSocket session needs of beast::basic_stream, whose rules it has: at most one
// read and one write are in flight, and a time limit ends both and closes.  Unlike a socket it may
// be destroyed while an operation is in flight, which TLS has in several steps. Thread: net-0.
class PeerStream {
 public:
  using executor_type = NetExecutor;

  explicit PeerStream(TcpSocket socket) : stream_(std::make_shared<Stream>(std::move(socket))) {}
  PeerStream(PeerStream&&) noexcept = default;
  PeerStream& operator=(PeerStream&&) = delete;
  // Ends what is in flight: after the end of a stream Asio would wait for more of it.
  ~PeerStream() {
    if (stream_) stream_->tcp.close();
  }

  // From now on what is read and written goes through TLS; async_handshake() first.
  void begin_tls(asio::ssl::context& keys) { stream_->tls.emplace(stream_->tcp, keys); }
  template <typename Handler>
  void async_handshake(Handler&& handler) {
    stream_->tls->async_handshake(asio::ssl::stream_base::server,
                                  keeping(std::forward<Handler>(handler)));
  }
  bool is_secure() const { return stream_->tls.has_value(); }
  // Of OpenSSL.  Requires begin_tls().
  SSL* tls() { return stream_->tls->native_handle(); }

  executor_type get_executor() { return stream_->tcp.get_executor(); }
  TcpSocket& socket() { return stream_->tcp.socket(); }
  const TcpSocket& socket() const { return stream_->tcp.socket(); }
  void expires_after(std::chrono::nanoseconds time) { stream_->tcp.expires_after(time); }
  void expires_never() { stream_->tcp.expires_never(); }
  void cancel() { stream_->tcp.cancel(); }
  void close() { stream_->tcp.close(); }
  // Tells the peer that nothing more will come.  Requires no write in flight.
  void finish() {
    if (stream_->tls) return stream_->tls->async_shutdown(keeping([](error_code) {}));
    error_code ignored;
    socket().shutdown(asio::socket_base::shutdown_send, ignored);
  }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    if (stream_->tls) {
      stream_->tls->async_read_some(buffers, keeping(std::forward<Handler>(handler)));
    } else {
      stream_->tcp.async_read_some(buffers, std::forward<Handler>(handler));
    }
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (stream_->tls) {
      stream_->tls->async_write_some(buffers, keeping(std::forward<Handler>(handler)));
    } else {
      stream_->tcp.async_write_some(buffers, std::forward<Handler>(handler));
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
  struct Stream {
    explicit Stream(TcpSocket socket) : tcp(std::move(socket)) {}
    TcpStream tcp;
    std::optional<asio::ssl::stream<TcpStream&>> tls;
  };
  template <typename Handler>
  Keeping<std::shared_ptr<Stream>, std::decay_t<Handler>> keeping(Handler&& handler) const {
    return {stream_, std::forward<Handler>(handler)};
  }

  std::shared_ptr<Stream> stream_;
};

using WsStream = websocket::stream<PeerStream>;

}  // namespace skerry::server
