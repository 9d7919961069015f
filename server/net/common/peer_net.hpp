// PeerNet: which connections are of one peer.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>

#include "server/net/common/asio.hpp"

namespace skerry::server {

// An IPv4 address (also one that came over an IPv6 socket); of an IPv6 address its first 64 bits;
// of a link-local one, which all hosts of a link share, the whole.
class PeerNet {
 public:
  PeerNet() = default;  // none that an address has
  explicit PeerNet(const asio::ip::address& address);
  // All addresses of the server's own host are one peer.
  static PeerNet own_host();

  std::string text() const;  // "192.0.2.7", "2001:db8::/64", "this host"

  auto operator<=>(const PeerNet&) const = default;

 private:
  std::array<std::uint8_t, 16> bytes_{};
  enum class Kind : std::uint8_t { none, own_host, address, network } kind_ = Kind::none;
};

}  // namespace skerry::server
