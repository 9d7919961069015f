// DatagramSocket: listens for UDP datagrams, unicast or multicast.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "clients/common/client_error.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::client {

// The address to listen on.  A multicast address is joined, on the default interface and on
// loopback; any other is the local address to listen on: 127.0.0.1 hears only this host, 0.0.0.0
// every interface.
struct UdpAddress {
  std::string address = kDefaultHost;
  std::uint16_t port = kDefaultUdpPort;  // 0: any free one
};

// "port", "address:port" or "[IPv6 address]:port".  Error: malformed, with what was expected.
ClientResult<UdpAddress> parse_udp_address(const std::string& text, std::uint16_t default_port);

// Thread: one at a time.
class DatagramSocket {
 public:
  // Error: unreachable (not an address of this host, port in use, no multicast there).
  static ClientResult<DatagramSocket> open(const UdpAddress& where);
  DatagramSocket(DatagramSocket&&) noexcept;
  DatagramSocket& operator=(DatagramSocket&&) noexcept;
  ~DatagramSocket();

  // The next datagram, valid until the next call; nothing if none came within `timeout`.
  // Error: closed if the system took the socket away.
  ClientResult<std::optional<std::span<const std::uint8_t>>> receive(Duration timeout);

  std::uint16_t port() const;       // the port listened on
  const std::string& name() const;  // "address:port", for messages

 private:
  class Socket;
  explicit DatagramSocket(std::unique_ptr<Socket> socket);
  std::unique_ptr<Socket> socket_;
};

}  // namespace skerry::client
