#include "server/net/native/tcp_transport.hpp"

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

class TcpTransport final : public ByteTransport {
 public:
  explicit TcpTransport(TcpSocket socket) : socket_(std::move(socket)), peer_(peer_of(socket_)) {
    set_stream_options(socket_);
  }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    socket_.async_read_some(asio::buffer(into.data(), into.size()), std::move(done));
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    asio::async_write(socket_, buffers, std::move(done));
  }
  void finish() override {
    error_code ignored;
    socket_.shutdown(asio::socket_base::shutdown_send, ignored);
  }
  void close() override {
    error_code ignored;
    socket_.close(ignored);
  }
  void limit_send_buffer(std::size_t bytes) override { set_send_buffer(socket_, bytes); }

  std::string name() const override { return "tcp"; }
  std::string peer() const override { return peer_.text; }
  bool peer_is_loopback() const override { return peer_.is_loopback; }

 private:
  TcpSocket socket_;
  TcpPeer peer_;
};

}  // namespace

std::unique_ptr<ByteTransport> make_tcp_transport(TcpSocket socket) {
  return std::make_unique<TcpTransport>(std::move(socket));
}

}  // namespace skerry::server
