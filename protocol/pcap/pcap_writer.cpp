#include "protocol/pcap/pcap_writer.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/pcap/ipv4_fragments.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::pcap {
namespace {

constexpr std::uint32_t kMagicNanoseconds = 0xA1B23C4D, kLinkEthernet = 1, kSnapLength = 65'535;
constexpr std::size_t kIpv4Header = 20, kFragment = 1480;  // octets
constexpr std::uint16_t kMoreFragments = 0x2000;
constexpr std::uint8_t kHops = 1;
// Locally administered.
constexpr std::array<std::uint8_t, 6> kSenderMac = {2, 0, 0, 0, 0, 1};
constexpr std::array<std::uint8_t, 6> kOtherMac = {2, 0, 0, 0, 0, 2};

void append_mac_of(Bytes& out, const Ipv4Endpoint& to) {
  if (!to.is_multicast()) {
    out.insert(out.end(), kOtherMac.begin(), kOtherMac.end());
    return;
  }
  // RFC 1112 6.4: the low 23 bits of the group.
  append_big_endian(out, 0x01005E, 3);
  append_big_endian(out, to.address & 0x7FFFFF, 3);
}

// RFC 791: of the header's 16-bit words, the checksum's own taken as zero.
std::uint16_t ipv4_checksum(std::span<const std::uint8_t> header) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < header.size(); i += 2)
    sum += big_endian_at<std::uint16_t>(header, i);
  while (sum > 0xFFFF) sum = (sum & 0xFFFF) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

}  // namespace

PcapWriter::PcapWriter(Sink sink) : sink_(std::move(sink)) {
  Bytes header;
  append_little_endian(header, kMagicNanoseconds, 4);
  append_little_endian(header, 2, 2);
  append_little_endian(header, 4, 2);
  append_little_endian(header, 0, 8);
  append_little_endian(header, kSnapLength, 4);
  append_little_endian(header, kLinkEthernet, 4);
  sink_(header);
}

void PcapWriter::add(UtcTime time, Ipv4Endpoint from, Ipv4Endpoint to,
                     std::span<const std::uint8_t> payload) {
  udp_.clear();
  append_big_endian(udp_, from.port, 2);
  append_big_endian(udp_, to.port, 2);
  append_big_endian(udp_, payload.size() + 8, 2);
  append_big_endian(udp_, 0, 2);
  udp_.insert(udp_.end(), payload.begin(), payload.end());
  for (std::size_t at = 0; at < udp_.size(); at += kFragment) {
    const std::size_t size = std::min(kFragment, udp_.size() - at);
    const bool more = at + size < udp_.size();
    add_frame(time, from, to, static_cast<std::uint16_t>(at / 8 | (more ? kMoreFragments : 0u)),
              std::span(udp_).subspan(at, size));
  }
  ++identification_;
  ++datagrams_;
}

void PcapWriter::add_frame(UtcTime time, Ipv4Endpoint from, Ipv4Endpoint to, std::uint16_t fragment,
                           std::span<const std::uint8_t> octets) {
  Bytes packet = {0x45, 0};
  append_big_endian(packet, kIpv4Header + octets.size(), 2);
  append_big_endian(packet, identification_, 2);
  append_big_endian(packet, fragment, 2);
  packet.push_back(kHops);
  packet.push_back(kProtocolUdp);
  append_big_endian(packet, 0, 2);
  append_big_endian(packet, from.address, 4);
  append_big_endian(packet, to.address, 4);
  put_big_endian(packet, 10, ipv4_checksum(packet), 2);

  const std::int64_t ns = std::max<std::int64_t>(time.time_since_epoch().count(), 0);
  const std::size_t size = 14 + packet.size() + octets.size();
  frame_.clear();
  append_little_endian(frame_, static_cast<std::uint64_t>(ns / 1'000'000'000), 4);
  append_little_endian(frame_, static_cast<std::uint64_t>(ns % 1'000'000'000), 4);
  append_little_endian(frame_, size, 4);
  append_little_endian(frame_, size, 4);
  append_mac_of(frame_, to);
  frame_.insert(frame_.end(), kSenderMac.begin(), kSenderMac.end());
  append_big_endian(frame_, 0x0800, 2);
  frame_.insert(frame_.end(), packet.begin(), packet.end());
  frame_.insert(frame_.end(), octets.begin(), octets.end());
  sink_(frame_);
}

}  // namespace skerry::pcap
