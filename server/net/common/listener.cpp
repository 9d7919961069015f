#include "server/net/common/listener.hpp"

#include <fmt/format.h>

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

Listener::Listener(NetContext& context, const ListenAddress& where, Accepted accepted)
    : context_(context),
      protocol_(where.protocol),
      accepted_(std::move(accepted)),
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
    if (ConnectionSlotPtr slot = context_.connections.try_enter()) {
      accepted_(std::move(socket), std::move(slot));
    } else {
      context_.errors.add(protocol_ + " refused", "too many connections; closed without a word");
    }
    accept();
  });
}

}  // namespace skerry::server
