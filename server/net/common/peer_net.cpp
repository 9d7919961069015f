#include "server/net/common/peer_net.hpp"

#include <algorithm>

namespace skerry::server {

PeerNet::PeerNet(const asio::ip::address& address) : kind_(Kind::address) {
  if (address.is_v4()) {
    bytes_ = asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4()).to_bytes();
    return;
  }
  bytes_ = address.to_v6().to_bytes();
  if (address.to_v6().is_v4_mapped() || address.to_v6().is_link_local()) return;
  std::fill(bytes_.begin() + 8, bytes_.end(), std::uint8_t{0});
  kind_ = Kind::network;
}

PeerNet PeerNet::own_host() {
  PeerNet net;
  net.kind_ = Kind::own_host;
  return net;
}

std::string PeerNet::text() const {
  if (kind_ == Kind::none) return "unknown";
  if (kind_ == Kind::own_host) return "this host";
  const asio::ip::address_v6 address(bytes_);
  if (address.is_v4_mapped()) {
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address).to_string();
  }
  return address.to_string() + (kind_ == Kind::network ? "/64" : "");
}

}  // namespace skerry::server
