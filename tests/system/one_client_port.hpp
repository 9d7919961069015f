// OneClientPort: a port of loopback that says the same bytes to everybody who connects.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "protocol/wire/wire_error.hpp"

namespace skerry::system_test {

// Listens from its construction on.  Error: std::runtime_error.
class OneClientPort {
 public:
  OneClientPort() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&at), size) != 0 ||
        ::listen(socket_, 16) != 0 ||
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size) != 0) {
      throw std::runtime_error("no port to listen on");
    }
    port_ = ntohs(at.sin_port);
  }
  ~OneClientPort() {
    thread_.request_stop();
    ::shutdown(socket_, SHUT_RDWR);
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
  }
  OneClientPort(const OneClientPort&) = delete;
  OneClientPort& operator=(const OneClientPort&) = delete;

  std::uint16_t port() const { return port_; }
  // One connection after another, each until the other end closes it.
  void answer_all_with(Bytes bytes) {
    thread_ = std::jthread([this, bytes = std::move(bytes)](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        const int peer = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
        if (peer < 0) return;
        std::array<char, 4096> said;
        ssize_t ignored = ::send(peer, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        while ((ignored = ::recv(peer, said.data(), said.size(), 0)) > 0) {
        }
        ::close(peer);
      }
    });
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
  std::jthread thread_;
};

}  // namespace skerry::system_test
