#include "server/net/native/stream_transport.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

class StreamTransport final : public ByteTransport {
 public:
  explicit StreamTransport(PeerStream stream) : stream_(std::move(stream)) {
    set_stream_options(stream_.socket());
    stream_.expires_never();
    error_code ignored;
    // For write_now(); asynchronous operations wait all the same.
    stream_.socket().non_blocking(true, ignored);
  }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    stream_.async_read_some(asio::buffer(into.data(), into.size()), std::move(done));
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    asio::async_write(stream_, buffers, std::move(done));
  }
  std::size_t write_now(const std::vector<asio::const_buffer>& buffers) override {
    if (stream_.is_secure()) return 0;
    error_code ignored;
    // send() is cheaper than sendmsg(), and most writes are of one sector.
    return buffers.size() == 1 ? stream_.socket().write_some(buffers.front(), ignored)
                               : stream_.socket().write_some(buffers, ignored);
  }
  // The owner's pending read keeps the stream until the peer has answered or the connection closed.
  void finish() override { stream_.finish(); }
  void close() override { stream_.close(); }
  void limit_send_buffer(std::size_t bytes) override { set_send_buffer(stream_.socket(), bytes); }

  std::string name() const override { return stream_.is_secure() ? "tls" : "tcp"; }

 private:
  PeerStream stream_;
};

}  // namespace

std::unique_ptr<ByteTransport> make_stream_transport(PeerStream stream) {
  return std::make_unique<StreamTransport>(std::move(stream));
}

}  // namespace skerry::server
