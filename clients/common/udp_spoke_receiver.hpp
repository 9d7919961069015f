// UdpSpokeReceiver: spokes of the native protocol over UDP.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "clients/common/datagram_socket.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/sequence_gap.hpp"

namespace skerry::client {

// Puts datagrams together and counts, by radar and view, what was lost.  Anybody can send a
// datagram, so garbage is counted and passed over; it never ends the reception.
// Memory: the reassembler's 1 MiB and kMaxViews loss counters.
// Thread: one at a time.
class UdpSpokeReceiver {
 public:
  static constexpr std::size_t kMaxViews = 256;

  // Error: as DatagramSocket::open().
  static ClientResult<UdpSpokeReceiver> open(const UdpAddress& where);

  // The next whole spoke, of whatever radar and view; nothing if none came within `timeout`.
  // Error: as DatagramSocket::receive().
  ClientResult<std::optional<Spoke>> receive(Duration timeout);

  std::uint16_t port() const { return socket_.port(); }
  const std::string& name() const { return socket_.name(); }

  using Views = std::map<std::pair<std::uint32_t, std::uint32_t>, LossCounter>;
  const Views& losses() const { return losses_; }  // by radar and view
  std::uint64_t refused() const {
    return reassembler_.refused() + malformed_;
  }  // datagrams, bodies

 private:
  explicit UdpSpokeReceiver(DatagramSocket socket) : socket_(std::move(socket)) {}
  std::optional<Spoke> take(std::span<const std::uint8_t> datagram);

  DatagramSocket socket_;
  DatagramReassembler reassembler_;
  Views losses_;
  std::uint64_t malformed_ = 0;
};

}  // namespace skerry::client
