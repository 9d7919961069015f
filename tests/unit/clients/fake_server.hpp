// FakeServer: one TCP connection on loopback that does what a test tells it to.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "clients/common/asio.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::client {

// The server's end of the connection.  Every call blocks until done or until the client has gone.
class FakePeer {
 public:
  explicit FakePeer(boost::asio::ip::tcp::socket socket) : socket_(std::move(socket)) {}

  // False once the client has gone.
  bool send_bytes(std::span<const std::uint8_t> bytes) {
    boost::system::error_code error;
    boost::asio::write(socket_, boost::asio::buffer(bytes.data(), bytes.size()), error);
    return !error;
  }
  bool send(const wire::ServerMessage& message) {
    Bytes bytes;
    append_frame(bytes, message);
    return send_bytes(bytes);
  }
  bool send(const Spoke& spoke) {
    Bytes bytes;
    append_spoke_frame(bytes, spoke);
    return send_bytes(bytes);
  }
  void say_hello(std::uint32_t version = 1) {
    wire::ServerMessage message;
    auto* hello = message.mutable_hello();
    hello->set_protocol_version(version);
    hello->set_server("fake 1");
    auto* radar = hello->add_radars();
    radar->set_name("Mast");
    send(message);
  }
  void answer(std::uint32_t request, wire::Reply::Code code = wire::Reply::OK,
              const std::string& text = {}) {
    wire::ServerMessage message;
    message.mutable_reply()->set_request(request);
    message.mutable_reply()->set_code(code);
    message.mutable_reply()->set_text(text);
    send(message);
  }

  // The client's next message; nothing once it has gone.
  std::optional<wire::ClientMessage> receive() {
    for (;;) {
      const auto body = frames_.next();
      if (!body) return std::nullopt;
      if (*body) {
        wire::ClientMessage message;
        if (!message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size()))) {
          return std::nullopt;
        }
        return message;
      }
      std::array<std::uint8_t, 4096> buffer;
      boost::system::error_code error;
      const std::size_t size = socket_.read_some(boost::asio::buffer(buffer), error);
      if (error) return std::nullopt;
      frames_.feed(std::span(buffer).first(size));
    }
  }
  // Answers the client's next message, which must be a subscription.
  bool accept_subscription() {
    const auto message = receive();
    if (!message || !message->has_subscribe()) return false;
    answer(message->request());
    return true;
  }
  void wait_until_client_leaves() {
    while (receive()) {
    }
  }

 private:
  boost::asio::ip::tcp::socket socket_;
  FrameReader frames_{kMaxClientFrame};
};

// Runs `script` with each of the first connections, each on a thread of its own, then closes it.
// Declare it before the client: it waits for the scripts to end.
class FakeServer {
 public:
  explicit FakeServer(std::function<void(FakePeer&)> script, int connections = 1)
      : thread_([this, run = std::move(script), connections] {
          std::vector<std::thread> scripts;
          for (int i = 0; i < connections; ++i) {
            boost::system::error_code error;
            boost::asio::ip::tcp::socket socket(io_);
            acceptor_.accept(socket, error);
            if (error) break;
            scripts.emplace_back([&run, peer = FakePeer(std::move(socket))]() mutable {
              FakePeer served = std::move(peer);  // closed when the script ends
              run(served);
            });
          }
          for (std::thread& each : scripts) each.join();
        }) {}
  ~FakeServer() {
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);  // ends an accept() nobody came to
    thread_.join();
  }
  std::uint16_t port() const { return port_; }

 private:
  boost::asio::io_context io_;
  boost::asio::ip::tcp::acceptor acceptor_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
  std::uint16_t port_ = acceptor_.local_endpoint().port();
  std::thread thread_;
};

// A port of loopback on which nobody listens.
inline std::uint16_t unused_port() {
  boost::asio::io_context io;
  return boost::asio::ip::tcp::acceptor(io, {boost::asio::ip::address_v4::loopback(), 0})
      .local_endpoint()
      .port();
}

}  // namespace skerry::client
