#include "tests/system/load_console.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
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

void read_ready(std::span<LoadReceiver* const> receivers) {
  constexpr int kLookAroundMs = 20;
  std::vector<pollfd> sockets;
  for (const LoadReceiver* receiver : receivers) sockets.push_back({receiver->socket(), POLLIN, 0});
  ::poll(sockets.data(), sockets.size(), kLookAroundMs);
  for (std::size_t i = 0; i < sockets.size(); ++i) {
    if (sockets[i].revents != 0) receivers[i]->read();
  }
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
  send_frame(bytes);
}

void LoadConsole::send_frame(const Bytes& bytes) {
  if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(bytes.size())) {
    fail("a request");
  }
}

void LoadConsole::subscribe(std::uint32_t radar) {
  wire::Subscribe asked;
  asked.set_radar(radar);
  subscribe(asked);
}

void LoadConsole::subscribe(const wire::Subscribe& subscribe) {
  wire::ClientMessage message;
  *message.mutable_subscribe() = subscribe;
  send(message);
}

void LoadConsole::set(const wire::Set& set) {
  wire::ClientMessage message;
  *message.mutable_set() = set;
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
  take(std::span(buffer).first(*size));
}

void LoadConsole::take(std::span<const std::uint8_t> bytes) {
  frames_.feed(bytes);
  for (;;) {
    const auto frame = frames_.next();
    if (!frame) throw std::runtime_error(name_ + " got no frame: " + frame.error().text);
    if (!*frame) return;
    if (!message_.ParseFromArray((*frame)->data(), static_cast<int>((*frame)->size()))) {
      throw std::runtime_error(name_ + " got no message");
    }
    if (message_.has_spoke()) spokes_.take(message_.spoke().sequence());
    if (message_.has_own_ship()) ++own_ships_;
    if (message_.has_exercise()) ++exercise_states_;
    if (message_.has_status()) {
      status_ = std::move(*message_.mutable_status());
      lost_before_status_ = spokes_.losses().lost();
    }
    if (message_.has_reply() && message_.reply().code() != wire::Reply::OK) {
      throw std::runtime_error(name_ + " was refused: " + message_.reply().text());
    }
  }
}

LoadWebConsole::LoadWebConsole(std::uint16_t http_port) : LoadConsole(http_port) {
  const std::string upgrade = "GET /ws HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(http_port) +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                              "Sec-WebSocket-Version: 13\r\n\r\n";
  LoadConsole::send_frame(Bytes(upgrade.begin(), upgrade.end()));
  std::string answer;
  for (char byte; !answer.ends_with("\r\n\r\n"); answer += byte) {
    if (::recv(socket_, &byte, 1, 0) != 1) fail("no answer to the upgrade of a WebSocket");
  }
  if (!answer.starts_with("HTTP/1.1 101")) throw std::runtime_error(answer);
}

// One masked message; a mask of zero changes no byte.
void LoadWebConsole::send_frame(const Bytes& frame) {
  if (frame.size() >= 65536) throw std::logic_error("a console's request is short");
  Bytes message = {0x82};
  if (frame.size() < 126) {
    message.push_back(static_cast<std::uint8_t>(0x80 | frame.size()));
  } else {
    message.insert(message.end(), {0x80 | 126, static_cast<std::uint8_t>(frame.size() >> 8),
                                   static_cast<std::uint8_t>(frame.size())});
  }
  message.insert(message.end(), 4, 0);
  message.insert(message.end(), frame.begin(), frame.end());
  LoadConsole::send_frame(message);
}

void LoadWebConsole::take(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    if (payload_left_ > 0) {
      const std::size_t size = std::min<std::uint64_t>(payload_left_, bytes.size());
      LoadConsole::take(bytes.first(size));
      bytes = bytes.subspan(size);
      payload_left_ -= size;
      continue;
    }
    unread_.push_back(bytes.front());
    bytes = bytes.subspan(1);
    if (unread_.size() < 2) continue;
    const std::size_t length = unread_[1] < 126 ? 0 : unread_[1] == 126 ? 2 : 8;
    if (unread_.size() < 2 + length) continue;
    payload_left_ = length == 0 ? unread_[1] : 0;
    for (std::size_t i = 2; i < unread_.size(); ++i)
      payload_left_ = payload_left_ << 8 | unread_[i];
    if ((unread_[0] & 0x0F) == 8) throw std::runtime_error(name() + " was closed by the server");
    if ((unread_[0] & 0x0F) > 2)
      throw std::runtime_error(name() + " got a ping, not foreseen here");
    unread_.clear();
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
