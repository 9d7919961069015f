#include "server/net/navigation/line_server.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <utility>

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

// How long a connection is not read from that has said too much.
constexpr std::chrono::milliseconds kPause{100};
// Bytes that may wait in the kernel for a slow receiver.
constexpr std::size_t kLinesSendBuffer = 32 * 1024;

}  // namespace

class LineSession final : public Connection, public std::enable_shared_from_this<LineSession> {
 public:
  LineSession(TcpSocket socket, ConnectionSlotPtr slot,
              std::shared_ptr<const LineServer::Handlers> handlers)
      : socket_(std::move(socket)),
        pause_(socket_.get_executor()),
        slot_(std::move(slot)),
        handlers_(std::move(handlers)),
        peer_(slot_->peer().text) {
    set_stream_options(socket_);
    set_send_buffer(socket_, kLinesSendBuffer);
  }

  void begin() {
    slot_->owner = weak_from_this();
    read();
  }

  void close() override {
    error_code ignored;
    socket_.close(ignored);
    pause_.cancel();
  }

  void send(const std::shared_ptr<const std::string>& text, std::size_t lines) {
    if (!socket_.is_open()) return;
    const bool fits = waiting_.size() + text->size() <= LineServer::kMostQueued;
    if (handlers_->on_sent) handlers_->on_sent(lines, text->size(), fits);
    if (!fits) return;
    waiting_ += *text;
    write();
  }

 private:
  void read() {
    socket_.async_read_some(asio::buffer(input_),
                            [self = shared_from_this()](error_code error, std::size_t size) {
                              if (error) return self->close();
                              self->take(std::string_view(self->input_.data(), size));
                            });
  }

  void take(std::string_view bytes) {
    bool wanted = true;
    while (!bytes.empty() && handlers_->on_line) {
      const std::size_t end = bytes.find_first_of("\r\n");
      const std::string_view part = bytes.substr(0, end);
      if (line_.size() + part.size() <= LineServer::kMostLine) {
        line_ += part;
      } else if (!overlong_) {
        overlong_ = true;
        if (handlers_->on_overlong) handlers_->on_overlong();
      }
      if (end == std::string_view::npos) break;
      bytes.remove_prefix(end + 1);
      if (!line_.empty() && !overlong_) wanted = handlers_->on_line(line_, peer_) && wanted;
      line_.clear();
      overlong_ = false;
    }
    if (wanted) return read();
    pause_.expires_after(kPause);
    pause_.async_wait([self = shared_from_this()](error_code error) {
      if (!error && self->socket_.is_open()) self->read();
    });
  }

  void write() {
    if (is_writing_ || waiting_.empty()) return;
    is_writing_ = true;
    on_the_way_ = std::exchange(waiting_, {});
    asio::async_write(socket_, asio::buffer(on_the_way_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        self->is_writing_ = false;
                        if (error) return self->close();
                        self->write();
                      });
  }

  TcpSocket socket_;
  Timer pause_;
  ConnectionSlotPtr slot_;
  std::shared_ptr<const LineServer::Handlers> handlers_;
  std::string peer_;
  std::array<char, 4096> input_{};
  std::string line_;
  bool overlong_ = false;
  std::string waiting_, on_the_way_;
  bool is_writing_ = false;
};

LineServer::LineServer(NetContext& context, const ListenAddress& where,
                       std::size_t most_connections, Handlers handlers)
    : context_(context),
      protocol_(where.protocol),
      most_connections_(most_connections),
      handlers_(std::make_shared<const Handlers>(std::move(handlers))),
      listener_(context, where, [this](TcpSocket socket, ConnectionSlotPtr slot) {
        accept(std::move(socket), std::move(slot));
      }) {}

void LineServer::accept(TcpSocket socket, ConnectionSlotPtr slot) {
  std::erase_if(sessions_, [](const auto& session) { return session.expired(); });
  error_code error;
  const auto peer = socket.remote_endpoint(error);
  if (error) return;
  if (handlers_->admits && !handlers_->admits(peer.address())) {
    context_.errors.add(protocol_ + " refused",
                        fmt::format("{} is not among the sources", peer.address().to_string()));
    return;
  }
  if (slot->place() == Place::refused || slot->place() == Place::on_trial ||
      sessions_.size() >= most_connections_) {
    context_.errors.add(protocol_ + " refused",
                        fmt::format("{}: too many connections", peer.address().to_string()));
    return;
  }
  auto session = std::make_shared<LineSession>(std::move(socket), std::move(slot), handlers_);
  session->begin();
  sessions_.push_back(session);
}

void LineServer::send(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line;
  const auto text = std::make_shared<const std::string>(std::move(all));
  for (const auto& known : sessions_) {
    if (const auto session = known.lock()) session->send(text, lines.size());
  }
}

void LineServer::close() {
  listener_.close();
  for (const auto& known : sessions_) {
    if (const auto session = known.lock()) session->close();
  }
}

}  // namespace skerry::server
