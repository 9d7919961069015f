#include "server/net/common/listener.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <utility>

namespace skerry::server {
namespace {

// When the process has no descriptor left, accept fails at once and for ever; the pause keeps it
// from taking the whole thread.
constexpr std::chrono::milliseconds kRetryPause{100};

std::string advice(const error_code& error, const ListenAddress& where) {
  if (error == asio::error::address_in_use) {
    return fmt::format("choose another with {}", where.option);
  }
  if (error == asio::error::access_denied) {
    return fmt::format("ports below 1024 need privileges; choose another with {}", where.option);
  }
  return "choose an address of this machine with --bind";
}

void require_listening(const error_code& error, const ListenAddress& where) {
  if (!error) return;
  throw std::runtime_error(fmt::format("{}: cannot listen on {} port {}: {}; {}", where.protocol,
                                       where.address, where.port, error.message(),
                                       advice(error, where)));
}

}  // namespace

Listener::Listener(NetContext& context, const ListenAddress& where, Accepted accepted,
                   LastWord last_word)
    : context_(context),
      protocol_(where.protocol),
      accepted_(std::move(accepted)),
      last_word_(std::move(last_word)),
      acceptor_(context.io),
      socket_(context.io),
      retry_(context.io) {
  error_code error;
  const auto address = asio::ip::make_address(where.address, error);
  require_listening(error, where);
  const asio::ip::tcp::endpoint endpoint(address, where.port);
  acceptor_.open(endpoint.protocol(), error);
  require_listening(error, where);
  acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  require_listening(error, where);
  acceptor_.bind(endpoint, error);
  require_listening(error, where);
  acceptor_.listen(asio::socket_base::max_listen_connections, error);
  require_listening(error, where);
  port_ = acceptor_.local_endpoint().port();
}

void Listener::close() {
  error_code ignored;
  acceptor_.close(ignored);
  retry_.cancel();
}

void Listener::accept() {
  acceptor_.async_accept(socket_, [this](error_code error) {
    if (!acceptor_.is_open()) return;
    if (error) {
      context_.errors.add(protocol_ + " accept", error.message());
      retry_.expires_after(kRetryPause);
      retry_.async_wait([this](error_code cancelled) {
        if (!cancelled && acceptor_.is_open()) accept();
      });
      return;
    }
    TcpSocket socket = std::move(socket_);  // which is then as new
    const TcpPeer peer = peer_of(socket, context_.config.foreign_addresses);
    if (ConnectionSlotPtr slot = context_.connections.try_enter(peer)) {
      accepted_(std::move(socket), std::move(slot));
    } else {
      turn_away(std::move(socket), peer);
    }
    accept();
  });
}

// Nothing was sent yet, so that a few hundred bytes always fit; nobody waits for the peer.
void Listener::turn_away(TcpSocket socket, const TcpPeer& peer) {
  const std::string reason = context_.connections.refusal(peer);
  context_.complain(protocol_ + " turned away", peer.text + ": " + reason);
  if (!last_word_) return;
  error_code ignored;
  socket.non_blocking(true, ignored);
  socket.write_some(asio::buffer(last_word_(reason)), ignored);
  socket.shutdown(asio::socket_base::shutdown_send, ignored);
  // What is unread at the close would reset the connection, and the peer might not see the answer.
  std::array<char, 4096> unread;
  socket.read_some(asio::buffer(unread), ignored);
}

}  // namespace skerry::server
