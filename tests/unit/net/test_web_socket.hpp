// A blocking WebSocket client for tests, on a plain socket: RFC 6455 by hand.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "tests/unit/net/test_client.hpp"

namespace skerry::server {

class TestWebSocket {
 public:
  // `headers`: further ones, each with its line end.
  TestWebSocket(std::uint16_t port, const std::string& target, const std::string& headers = {})
      : socket_(port) {
    socket_.send("GET " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(port) +
                 "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                 "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                 "Sec-WebSocket-Version: 13\r\n" +
                 headers + "\r\n");
    while (answer_.find("\r\n\r\n") == std::string::npos) answer_ += next();
    if (!answer_.starts_with("HTTP/1.1 101")) throw std::runtime_error(answer_);
  }

  struct Message {
    bool binary = false;
    std::string data;
  };
  // The next message; nothing once the server has closed.
  std::optional<Message> receive() {
    Message message;
    for (bool last = false; !last;) {
      const auto first = byte();
      if (!first) return std::nullopt;
      last = (*first & 0x80) != 0;
      const unsigned opcode = *first & 0x0F;
      std::uint64_t size = byte().value_or(0) & 0x7F;
      if (size >= 126) {
        const int bytes = size == 126 ? 2 : 8;
        size = 0;
        for (int i = 0; i < bytes; ++i) size = size << 8 | byte().value_or(0);
      }
      for (std::uint64_t i = 0; i < size; ++i) {
        const auto data = byte();
        if (!data) return std::nullopt;
        if (opcode <= 2) message.data += static_cast<char>(*data);
      }
      if (opcode == 8) return std::nullopt;
      if (opcode > 2) last = false;
      if (opcode == 2) message.binary = true;
    }
    return message;
  }

  // One final text frame, masked with 0, which changes no byte.
  void send(const std::string& text) {
    std::string frame = "\x81";
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8) {
        frame += static_cast<char>(std::uint64_t{text.size()} >> shift & 0xFF);
      }
    }
    socket_.send(frame + std::string(4, '\0') + text);
  }

 private:
  std::string next() {
    const auto one = byte();
    if (!one) throw std::runtime_error("the server closed in the handshake: " + answer_);
    return std::string(1, static_cast<char>(*one));
  }
  std::optional<std::uint8_t> byte() {
    if (at_ == unread_.size()) {
      unread_ = socket_.receive();
      at_ = 0;
    }
    if (unread_.empty()) return std::nullopt;
    return unread_[at_++];
  }

  TestSocket socket_;
  std::string answer_;
  Bytes unread_;
  std::size_t at_ = 0;
};

}  // namespace skerry::server
