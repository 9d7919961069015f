// Blocking clients for tests, on plain sockets: nothing shared with the server's own networking.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/net/net_server.hpp"

namespace skerry::server {

// A TCP connection to a port of this host.  A read that gets nothing for 30 s fails the test by
// an exception: only a broken server is so late.
class TestSocket {
 public:
  // `receive_buffer` 0: the system's default.
  // `from`: the address it connects from; nullptr: 127.0.0.1.
  explicit TestSocket(std::uint16_t port, int receive_buffer = 0, const char* from = nullptr);
  ~TestSocket() { close(); }
  TestSocket(const TestSocket&) = delete;
  TestSocket& operator=(const TestSocket&) = delete;

  // False if the server has closed.
  bool send(std::span<const std::uint8_t> bytes);
  bool send(const std::string& text);
  // Up to `max` bytes; none: the server has closed.
  Bytes receive(std::size_t max = 65536);
  std::string receive_all();  // until the server closes
  void finish_sending();
  void reset();  // closes with RST
  void close();

 private:
  int socket_ = -1;
};

wire::ClientMessage subscribe_message(std::uint32_t request, std::uint32_t radar);
wire::ClientMessage set_gain_message(std::uint32_t request, std::uint32_t radar, double gain);
wire::ClientMessage get_status_message(std::uint32_t request);
Bytes frame_of(const wire::ClientMessage& message);

// A client of the native protocol, over TCP or WebSocket.
class TestClient {
 public:
  static constexpr int kDefaultBuffer = 0;

  explicit TestClient(std::uint16_t tcp_port, int receive_buffer = kDefaultBuffer,
                      const char* from = nullptr);
  // Upgrades at the HTTP port; checks the handshake.
  static TestClient over_websocket(std::uint16_t http_port, const char* from = nullptr);

  void send(const wire::ClientMessage& message) { send_bytes(frame_of(message)); }
  void send_bytes(const Bytes& bytes);

  // The next message; nothing if the server has closed.
  std::optional<wire::ServerMessage> receive();
  // The next reply.  An exception if the server closes before.
  wire::Reply receive_reply();
  wire::Status get_status();
  wire::Hello receive_hello();
  // Subscribes and receives the reply: what is published from now on comes.
  void subscribe(std::uint32_t radar = 0);

  // Receives until spoke `last` has come; counts what came and what is missing in the sequence.
  struct Received {
    std::uint64_t spokes = 0;
    std::uint64_t missing = 0;
  };
  Received receive_spokes_until(std::uint64_t last);

  TestSocket& socket() { return *socket_; }
  // Sees what receive_reply() and receive_spokes_until() pass over, and every spoke.
  std::function<void(const wire::ServerMessage&)> on_message;

 private:
  explicit TestClient(std::unique_ptr<TestSocket> socket) : socket_(std::move(socket)) {}
  bool fill();  // reads more into reader_; false if the server has closed

  std::unique_ptr<TestSocket> socket_;
  FrameReader reader_{kMaxServerFrame};
  bool websocket_ = false;
  bool closed_ = false;  // by a WebSocket close frame
  Bytes unread_;         // WebSocket: bytes received but not yet whole frames
  std::uint64_t next_sequence_ = 0;
};

// Sends a whole HTTP request and returns the whole answer; the request must ask to close.
std::string http_exchange(std::uint16_t port, const std::string& request,
                          const char* from = nullptr);
std::string http_get(std::uint16_t port, const std::string& target, const char* from = nullptr);

// Waits for a condition another thread brings about; false after 30 s.
bool wait_until(const std::function<bool()>& condition);

// A configuration for tests: any free ports, nobody to send datagrams to.
NetConfig test_config();

}  // namespace skerry::server
