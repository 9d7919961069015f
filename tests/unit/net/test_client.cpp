#include "tests/unit/net/test_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace skerry::server {
namespace {

constexpr int kPatienceSeconds = 30;

void fail(const std::string& what) { throw std::runtime_error(what); }

}  // namespace

TestSocket::TestSocket(std::uint16_t port, int receive_buffer, const char* from)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer > 0) {
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  const timeval patience{kPatienceSeconds, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (from != nullptr) {
    address.sin_addr.s_addr = ::inet_addr(from);
    ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail("cannot connect to port " + std::to_string(port));
  }
}

bool TestSocket::send(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool TestSocket::send(const std::string& text) {
  return send({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Bytes TestSocket::receive(std::size_t max) {
  Bytes bytes(max);
  const auto size = ::recv(socket_, bytes.data(), bytes.size(), 0);
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) fail("the server sends nothing");
  bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));  // a reset is a close
  return bytes;
}

std::string TestSocket::receive_all() {
  std::string all;
  for (Bytes bytes = receive(); !bytes.empty(); bytes = receive()) {
    all.append(bytes.begin(), bytes.end());
  }
  return all;
}

void TestSocket::finish_sending() { ::shutdown(socket_, SHUT_WR); }

void TestSocket::reset() {
  const linger at_once{1, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close();
}

void TestSocket::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

wire::ClientMessage subscribe_message(std::uint32_t request, std::uint32_t radar) {
  wire::ClientMessage message;
  message.set_request(request);
  message.mutable_subscribe()->set_radar(radar);
  return message;
}

wire::ClientMessage set_gain_message(std::uint32_t request, std::uint32_t radar, double gain) {
  wire::ClientMessage message;
  message.set_request(request);
  message.mutable_set()->set_radar(radar);
  message.mutable_set()->set_gain(gain);
  return message;
}

wire::ClientMessage get_status_message(std::uint32_t request) {
  wire::ClientMessage message;
  message.set_request(request);
  message.mutable_get_status();
  return message;
}

Bytes frame_of(const wire::ClientMessage& message) {
  Bytes bytes;
  append_frame(bytes, message);
  return bytes;
}

TestClient::TestClient(std::uint16_t tcp_port, int receive_buffer, const char* from)
    : socket_(std::make_unique<TestSocket>(tcp_port, receive_buffer, from)) {}

TestClient TestClient::over_websocket(std::uint16_t http_port, const char* from) {
  TestClient client(std::make_unique<TestSocket>(http_port, 0, from));
  client.websocket_ = true;
  client.socket_->send("GET /ws HTTP/1.1\r\nHost: localhost:" + std::to_string(http_port) +
                       "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                       "Sec-WebSocket-Version: 13\r\n\r\n");
  std::string header;
  while (header.find("\r\n\r\n") == std::string::npos) {
    const Bytes byte = client.socket_->receive(1);
    if (byte.empty()) fail("the server closed in the handshake: " + header);
    header += static_cast<char>(byte.front());
  }
  // The example of RFC 6455 section 1.3: this key, that answer.
  if (!header.starts_with("HTTP/1.1 101") ||
      header.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") == std::string::npos) {
    fail("no WebSocket handshake: " + header);
  }
  return client;
}

void TestClient::send_bytes(const Bytes& bytes) {
  if (!websocket_) {
    socket_->send(bytes);
    return;
  }
  // RFC 6455 section 5.2: one final binary frame, masked with 0, which changes no byte.
  Bytes message = {0x82};
  if (bytes.size() < 126) {
    message.push_back(static_cast<std::uint8_t>(0x80 | bytes.size()));
  } else {
    message.push_back(0x80 | 126);
    message.push_back(static_cast<std::uint8_t>(bytes.size() >> 8));
    message.push_back(static_cast<std::uint8_t>(bytes.size()));
  }
  message.insert(message.end(), 4, 0);
  message.insert(message.end(), bytes.begin(), bytes.end());
  socket_->send(message);
}

bool TestClient::fill() {
  if (closed_) return false;
  const Bytes bytes = socket_->receive();
  if (bytes.empty()) return false;
  if (!websocket_) {
    reader_.feed(bytes);
    return true;
  }
  unread_.insert(unread_.end(), bytes.begin(), bytes.end());
  std::size_t at = 0;
  while (unread_.size() - at >= 2) {
    std::size_t header = 2;
    std::size_t length = unread_[at + 1];  // a server does not mask
    if (length >= 126) {
      header = length == 126 ? 4 : 10;
      if (unread_.size() - at < header) break;
      length = 0;
      for (std::size_t i = 2; i < header; ++i) length = length << 8 | unread_[at + i];
    }
    if (unread_.size() - at < header + length) break;
    const std::uint8_t kind = unread_[at];
    if (kind == 0x88) {
      closed_ = true;  // what came before is still to be received
      return true;
    }
    if (kind != 0x82) fail("a WebSocket frame of kind " + std::to_string(kind));
    const auto payload = std::span(unread_).subspan(at + header, length);
    // A message holds whole frames: feed it alone and see that nothing is left over.
    FrameReader whole(kMaxServerFrame);
    whole.feed(payload);
    for (auto frame = whole.next(); frame.ok() && frame->has_value();) frame = whole.next();
    if (whole.pending() != 0) fail("a WebSocket message that ends within a frame");
    reader_.feed(payload);
    at += header + length;
  }
  unread_.erase(unread_.begin(), unread_.begin() + static_cast<std::ptrdiff_t>(at));
  return true;
}

std::optional<wire::ServerMessage> TestClient::receive() {
  while (true) {
    const auto frame = reader_.next();
    if (!frame.ok()) fail("the server's stream: " + frame.error().text);
    if (frame->has_value()) {
      wire::ServerMessage message;
      const auto body = **frame;
      if (!message.ParseFromArray(body.data(), static_cast<int>(body.size()))) {
        fail("no ServerMessage");
      }
      return message;
    }
    if (!fill()) return std::nullopt;
  }
}

wire::Reply TestClient::receive_reply() {
  while (const auto message = receive()) {
    if (message->has_reply()) return message->reply();
    if (on_message) on_message(*message);
  }
  throw std::runtime_error("the server closed instead of replying");
}

wire::Status TestClient::get_status() {
  send(get_status_message(1));
  wire::Status status;
  while (const auto message = receive()) {
    if (message->has_status()) status = message->status();
    if (message->has_reply()) return status;
  }
  throw std::runtime_error("the server closed instead of giving its status");
}

wire::Hello TestClient::receive_hello() {
  const auto message = receive();
  if (!message || !message->has_hello()) fail("the first message is no Hello");
  return message->hello();
}

void TestClient::subscribe(std::uint32_t radar) {
  send(subscribe_message(7, radar));
  const wire::Reply reply = receive_reply();
  if (reply.request() != 7 || reply.code() != wire::Reply::OK) fail("subscribe: " + reply.text());
}

TestClient::Received TestClient::receive_spokes_until(std::uint64_t last) {
  Received received;
  while (next_sequence_ <= last) {
    const auto message = receive();
    if (!message) fail("the server closed while sending spokes");
    if (!message->has_spoke()) {
      if (on_message) on_message(*message);
      continue;
    }
    ++received.spokes;
    received.missing += message->spoke().sequence() - next_sequence_;
    next_sequence_ = message->spoke().sequence() + 1;
    if (on_message) on_message(*message);
  }
  return received;
}

std::string http_exchange(std::uint16_t port, const std::string& request, const char* from) {
  TestSocket socket(port, 0, from);
  socket.send(request);
  return socket.receive_all();
}

std::string http_get(std::uint16_t port, const std::string& target, const char* from) {
  return http_exchange(port,
                       "GET " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(port) +
                           "\r\nConnection: close\r\n\r\n",
                       from);
}

bool wait_until(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(kPatienceSeconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

NetConfig test_config() {
  NetConfig config;
  config.tcp_port = 0;
  config.http_port = 0;
  return config;
}

}  // namespace skerry::server
