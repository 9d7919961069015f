#include "tests/system/load_console.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace skerry::system_test {
namespace {

constexpr int kUdpReceiveBuffer = 4 * 1024 * 1024;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

int opened(int type) {
  const int socket = ::socket(AF_INET, type | SOCK_CLOEXEC, 0);
  if (socket < 0) fail("no socket");
  return socket;
}

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

std::uint16_t own_port(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) fail("no port");
  return ntohs(address.sin_port);
}

// The size of what was received; nothing if nothing is there.
std::optional<std::size_t> receive(int socket, std::span<std::uint8_t> into) {
  const ssize_t size = ::recv(socket, into.data(), into.size(), MSG_DONTWAIT);
  if (size >= 0) return static_cast<std::size_t>(size);
  if (errno == EAGAIN || errno == EINTR) return std::nullopt;
  fail("a receiver's socket");
}

}  // namespace

void SpokeCount::take(std::uint64_t sequence) {
  if (losses_.take(sequence) && sequence >= count_from_) ++counted_;
  newest_ = std::max(newest_.value_or(0), sequence);
}

LoadReceiver::~LoadReceiver() { ::close(socket_); }

LoadConsole::LoadConsole(std::uint16_t port, int receive_buffer)
    : LoadReceiver(opened(SOCK_STREAM)) {
  if (receive_buffer > 0) {
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  const sockaddr_in address = loopback(port);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail("cannot connect to port " + std::to_string(port));
  }
  name_ = "127.0.0.1:" + std::to_string(own_port(socket_));
}

void LoadConsole::send(wire::ClientMessage& message) {
  message.set_request(++requests_);
  Bytes bytes;
  append_frame(bytes, message);
  if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(bytes.size())) {
    fail("a request");
  }
}

void LoadConsole::subscribe(std::uint32_t radar) {
  wire::ClientMessage message;
  message.mutable_subscribe()->set_radar(radar);
  send(message);
}

void LoadConsole::ask_status() {
  status_.reset();
  wire::ClientMessage message;
  message.mutable_get_status();
  send(message);
}

void LoadConsole::read() {
  std::array<std::uint8_t, 65536> buffer;
  const auto size = receive(socket_, buffer);
  if (!size) return;
  if (*size == 0) throw std::runtime_error("the server closed the connection of " + name_);
  bytes_ += *size;
  frames_.feed(std::span(buffer).first(*size));
  for (;;) {
    const auto frame = frames_.next();
    if (!frame) throw std::runtime_error(name_ + " got no frame: " + frame.error().text);
    if (!*frame) return;
    if (!message_.ParseFromArray((*frame)->data(), static_cast<int>((*frame)->size()))) {
      throw std::runtime_error(name_ + " got no message");
    }
    if (message_.has_spoke()) spokes_.take(message_.spoke().sequence());
    if (message_.has_status()) status_ = std::move(*message_.mutable_status());
    if (message_.has_reply() && message_.reply().code() != wire::Reply::OK) {
      throw std::runtime_error(name_ + " was refused: " + message_.reply().text());
    }
  }
}

LoadSubscriber::LoadSubscriber() : LoadReceiver(opened(SOCK_DGRAM)), buffer_(65536) {
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kUdpReceiveBuffer, sizeof kUdpReceiveBuffer);
  const sockaddr_in address = loopback(0);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail("no UDP port");
  }
  port_ = own_port(socket_);
}

void LoadSubscriber::read() {
  while (const auto size = receive(socket_, buffer_)) {
    bytes_ += *size;
    const std::span datagram = std::span(buffer_).first(*size);
    const auto header = decode_datagram_header(datagram);
    const auto body = reassembler_.feed(datagram);
    if (!header || !body) throw std::runtime_error("a datagram that is none of Skerry's");
    if (*body) spokes_.take(header->spoke.sequence);
  }
}

}  // namespace skerry::system_test
