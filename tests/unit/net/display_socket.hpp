// DisplaySocket: the network side of a radar display, for tests.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::server {

// Hears one group, or unicast, on an interface of this host, and sends from that interface.
class DisplaySocket {
 public:
  struct Received {
    Ipv4Endpoint from;
    Bytes payload;
    std::chrono::nanoseconds time{};  // when this host's network had it, since 1970
  };

  // `group` 0.0.0.0: the interface's own address; port 0: any free one.
  // Error: std::runtime_error.
  DisplaySocket(Ipv4Endpoint group, std::uint32_t interface_address);
  ~DisplaySocket();
  DisplaySocket(const DisplaySocket&) = delete;
  DisplaySocket& operator=(const DisplaySocket&) = delete;

  std::uint16_t port() const { return port_; }
  void send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload);
  void send(const Ipv4Endpoint& to, const std::string& text);

  // The next datagram from `from` (any address: 0), so that other radars on the same host do not
  // disturb; nothing if none came within `patience`.
  std::optional<Received> receive(std::uint32_t from = 0,
                                  std::chrono::milliseconds patience = std::chrono::seconds(30));

 private:
  int hears_ = -1, sends_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace skerry::server
