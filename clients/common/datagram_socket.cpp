#include "clients/common/datagram_socket.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <utility>

#include "clients/common/asio.hpp"
#include "protocol/wire/host_and_port.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

namespace asio = boost::asio;
using asio::ip::udp;
using boost::system::error_code;
using std::chrono::steady_clock;

constexpr int kReceiveBuffer = 4 << 20;  // two seconds of 1.7 MB/s; the system may grant less

Failure<ClientError> unusable(const std::string& name, const std::string& why) {
  return Failure{ClientError{ClientErrorKind::unreachable,
                             fmt::format("cannot listen on UDP {}: {}", name, printable(why))}};
}

std::string name_of(const UdpAddress& where) {
  return host_and_port(printable(where.address), where.port);
}

}  // namespace

ClientResult<UdpAddress> parse_udp_address(const std::string& text, std::uint16_t default_port) {
  UdpAddress where;
  const auto colon = text.rfind(':');
  std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  if (colon != std::string::npos) where.address = text.substr(0, colon);
  if (where.address.size() >= 2 && where.address.front() == '[' && where.address.back() == ']') {
    where.address = where.address.substr(1, where.address.size() - 2);
  }
  if (port.empty() && colon != std::string::npos) port = std::to_string(default_port);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), where.port);
  error_code no_address;
  asio::ip::make_address(where.address, no_address);
  if (error != std::errc{} || end != port.data() + port.size() || no_address) {
    return Failure{ClientError{
        ClientErrorKind::malformed,
        fmt::format("'{}' is no UDP address; expected port or address:port, such as {} or "
                    "239.192.43.78:{}",
                    printable(text), default_port, default_port)}};
  }
  return where;
}

class DatagramSocket::Socket {
 public:
  ClientResult<Done> open(const UdpAddress& where);
  ClientResult<std::optional<std::span<const std::uint8_t>>> receive(Duration timeout);
  std::uint16_t port() const { return port_; }
  const std::string& name() const { return name_; }

 private:
  // Joins on the default interface and on loopback; one of the two is enough.
  error_code join(const asio::ip::address& group);

  asio::io_context io_;
  udp::socket socket_{io_};
  std::array<std::uint8_t, 65536> buffer_{};
  std::size_t size_ = 0;
  error_code error_;
  bool reading_ = false;
  bool done_ = false;
  std::uint16_t port_ = 0;
  std::string name_;
};

error_code DatagramSocket::Socket::join(const asio::ip::address& group) {
  error_code by_default, on_loopback;
  socket_.set_option(asio::ip::multicast::join_group(group), by_default);
  if (group.is_v4()) {
    socket_.set_option(
        asio::ip::multicast::join_group(group.to_v4(), asio::ip::address_v4::loopback()),
        on_loopback);
  } else {
    on_loopback = by_default;
  }
  return by_default && on_loopback ? by_default : error_code{};
}

ClientResult<Done> DatagramSocket::Socket::open(const UdpAddress& where) {
  name_ = name_of(where);
  error_code error;
  const auto address = asio::ip::make_address(where.address, error);
  if (error) return unusable(name_, "not an IP address");
  const udp::endpoint endpoint(address, where.port);
  if (socket_.open(endpoint.protocol(), error)) return unusable(name_, error.message());
  error_code ignored;
  socket_.set_option(asio::socket_base::receive_buffer_size(kReceiveBuffer), ignored);
  // Several programs may listen to one group; a unicast port belongs to one.
  if (address.is_multicast()) {
    socket_.set_option(asio::socket_base::reuse_address(true), ignored);
  }
  if (socket_.bind(endpoint, error)) return unusable(name_, error.message());
  if (address.is_multicast()) {
    if ((error = join(address))) return unusable(name_, "joining the group: " + error.message());
  }
  port_ = socket_.local_endpoint(error).port();
  if (error) return unusable(name_, error.message());
  name_ = name_of({where.address, port_});
  return Done{};
}

ClientResult<std::optional<std::span<const std::uint8_t>>> DatagramSocket::Socket::receive(
    Duration timeout) {
  using Datagram = std::optional<std::span<const std::uint8_t>>;
  if (!reading_) {
    reading_ = true;
    done_ = false;
    socket_.async_receive(asio::buffer(buffer_), [this](const error_code& e, std::size_t size) {
      error_ = e;
      size_ = size;
      done_ = true;
    });
  }
  const auto deadline =
      steady_clock::now() + std::clamp<Duration>(timeout, {}, std::chrono::hours(24 * 365));
  while (!done_) {
    io_.restart();
    // One turn may do nothing but take an old readiness off the reactor, hence the loop;
    // run_one_until() does not even look once the deadline has passed, poll_one() does.
    if (io_.run_one_until(deadline) == 0 && io_.poll_one() == 0) break;
  }
  if (!done_) return Datagram{};
  reading_ = false;
  if (error_) {
    return Failure{ClientError{ClientErrorKind::closed,
                               fmt::format("UDP {}: {}", name_, printable(error_.message()))}};
  }
  return Datagram(std::span<const std::uint8_t>(buffer_).first(size_));
}

ClientResult<DatagramSocket> DatagramSocket::open(const UdpAddress& where) {
  auto socket = std::make_unique<Socket>();
  if (auto opened = socket->open(where); !opened) return Failure{opened.error()};
  return DatagramSocket(std::move(socket));
}

DatagramSocket::DatagramSocket(std::unique_ptr<Socket> socket) : socket_(std::move(socket)) {}
DatagramSocket::DatagramSocket(DatagramSocket&&) noexcept = default;
DatagramSocket& DatagramSocket::operator=(DatagramSocket&&) noexcept = default;
DatagramSocket::~DatagramSocket() = default;

ClientResult<std::optional<std::span<const std::uint8_t>>> DatagramSocket::receive(
    Duration timeout) {
  return socket_->receive(timeout);
}
std::uint16_t DatagramSocket::port() const { return socket_->port(); }
const std::string& DatagramSocket::name() const { return socket_->name(); }

}  // namespace skerry::client
