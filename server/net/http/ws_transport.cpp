#include "server/net/http/ws_transport.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

class WsTransport final : public ByteTransport {
 public:
  explicit WsTransport(std::unique_ptr<WsStream> stream) : stream_(std::move(stream)) {
    set_stream_options(beast::get_lowest_layer(*stream_).socket());
    beast::get_lowest_layer(*stream_).expires_never();
    stream_->binary(true);
    stream_->auto_fragment(false);  // a batch is one message: header and shared buffers, no copy
    stream_->read_message_max(0);   // read piecewise; FrameReader bounds what is kept
  }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    stream_->async_read_some(
        asio::buffer(into.data(), into.size()),
        [stream = stream_.get(), done = std::move(done)](error_code error, std::size_t size) {
          if (!error && stream->got_text()) {
            error = make_error_code(boost::system::errc::bad_message);
          }
          done(error, size);
        });
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    stream_->async_write(buffers, std::move(done));
  }
  void finish() override {
    // The owner's pending read keeps the stream until this is done or the connection closed.
    stream_->async_close(websocket::close_code::policy_error, [](error_code) {});
  }
  void close() override { beast::get_lowest_layer(*stream_).close(); }
  void limit_send_buffer(std::size_t bytes) override {
    set_send_buffer(beast::get_lowest_layer(*stream_).socket(), bytes);
  }

  std::string name() const override { return "websocket"; }

 private:
  std::unique_ptr<WsStream> stream_;
};

}  // namespace

std::unique_ptr<ByteTransport> make_ws_transport(std::unique_ptr<WsStream> stream) {
  return std::make_unique<WsTransport>(std::move(stream));
}

}  // namespace skerry::server
