#include "clients/common/udp_spoke_receiver.hpp"

#include <algorithm>
#include <chrono>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::client {

ClientResult<UdpSpokeReceiver> UdpSpokeReceiver::open(const UdpAddress& where) {
  auto socket = DatagramSocket::open(where);
  if (!socket) return Failure{socket.error()};
  return UdpSpokeReceiver(std::move(socket).value());
}

std::optional<Spoke> UdpSpokeReceiver::take(std::span<const std::uint8_t> datagram) {
  auto body = reassembler_.feed(datagram);
  if (!body || !*body) return std::nullopt;
  wire::ServerMessage message;
  if (!message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size()))) {
    ++malformed_;
    return std::nullopt;
  }
  if (!message.has_spoke()) return std::nullopt;
  auto spoke = from_message(message.spoke());
  const std::pair view{message.spoke().radar(), message.spoke().view()};
  if (!spoke || (losses_.size() >= kMaxViews && !losses_.contains(view))) {
    ++malformed_;
    return std::nullopt;
  }
  if (!losses_[view].take(spoke->header.sequence)) return std::nullopt;
  return std::move(spoke).value();
}

ClientResult<std::optional<Spoke>> UdpSpokeReceiver::receive(Duration timeout) {
  using std::chrono::steady_clock;
  const auto deadline =
      steady_clock::now() + std::clamp<Duration>(timeout, {}, std::chrono::hours(24 * 365));
  do {
    auto datagram = socket_.receive(deadline - steady_clock::now());
    if (!datagram) return Failure{datagram.error()};
    if (!*datagram) break;
    if (auto spoke = take(**datagram)) return spoke;
  } while (steady_clock::now() < deadline);
  return std::optional<Spoke>{};
}

}  // namespace skerry::client
