#include "tests/bench/fan_out/wire_console.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::bench {
namespace {

constexpr std::string_view kUpgrade =
    "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

std::string subscription() {
  wire::ClientMessage message;
  message.set_request(1);
  message.mutable_subscribe()->set_radar(0);
  Bytes bytes;
  append_frame(bytes, message);
  return {bytes.begin(), bytes.end()};
}

// A whole binary message with a mask of zeros.  Source: RFC 6455, 5.2.
std::string as_message(const std::string& bytes) {
  constexpr char kWholeBinary = '\x82', kMasked = '\x80';
  return std::string{kWholeBinary, static_cast<char>(kMasked | static_cast<char>(bytes.size()))} +
         std::string(4, '\0') + bytes;
}

// One for all: they check no certificate.
SSL_CTX* client_context() {
  static SSL_CTX* const context = ::SSL_CTX_new(::TLS_client_method());
  return context;
}

}  // namespace

const char* name_of(Way way) {
  constexpr std::array kNames = {"bare", "native", "ws", "wss"};
  return kNames.at(static_cast<std::size_t>(way));
}

void WireConsole::Closes::operator()(int* socket) const {
  ::close(*socket);
  delete socket;
}

WireConsole::WireConsole(Way way, std::uint16_t port)
    : socket_(new int(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))) {
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(port);
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(*socket_, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0) {
    throw std::runtime_error("a console could not connect");
  }
  if (way == Way::wss) {
    ssl_.reset(::SSL_new(client_context()));
    ::SSL_set_fd(ssl_.get(), *socket_);
    if (::SSL_connect(ssl_.get()) != 1) throw std::runtime_error("a console's handshake failed");
  }
  if (way == Way::bare) return;
  if (way == Way::native) {
    write(subscription());
    return;
  }
  write(kUpgrade);
  std::string answer;
  std::array<char, 4096> piece;
  while (answer.find("\r\n\r\n") == std::string::npos) {
    const std::size_t got = read(piece);
    if (got == 0) throw std::runtime_error("a console's upgrade failed");
    answer.append(piece.data(), got);
  }
  if (!answer.starts_with("HTTP/1.1 101")) throw std::runtime_error(answer.substr(0, 40));
  write(as_message(subscription()));
}

void WireConsole::write(std::span<const char> bytes) {
  const auto size = static_cast<ssize_t>(bytes.size());
  const ssize_t done = ssl_ ? ::SSL_write(ssl_.get(), bytes.data(), static_cast<int>(size))
                            : ::send(*socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (done != size) throw std::runtime_error("a console could not subscribe");
}

std::size_t WireConsole::read(std::span<char> into) {
  const ssize_t got = ssl_ ? ::SSL_read(ssl_.get(), into.data(), static_cast<int>(into.size()))
                           : ::recv(*socket_, into.data(), into.size(), 0);
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

}  // namespace skerry::bench
