// PcapWriter: datagrams as a capture that every analyser reads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::pcap {

// pcap with nanoseconds, Ethernet; datagrams beyond 1480 octets are cut into IPv4 fragments, as
// they are on the wire.  The UDP checksum is left out, which IPv4 allows.  Thread: one at a time.
class PcapWriter {
 public:
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  static constexpr std::size_t kMaxPayload = 65'507;

  explicit PcapWriter(Sink sink);  // writes the file's header

  // Requires at most kMaxPayload octets.  Times before 1970 are written as 1970, those beyond 2106
  // wrap: the format has 32 bits of seconds.
  void add(UtcTime time, Ipv4Endpoint from, Ipv4Endpoint to, std::span<const std::uint8_t> payload);
  std::uint64_t datagrams() const { return datagrams_; }

 private:
  void add_frame(UtcTime time, Ipv4Endpoint from, Ipv4Endpoint to, std::uint16_t fragment,
                 std::span<const std::uint8_t> octets);

  Sink sink_;
  Bytes udp_, frame_;
  std::uint16_t identification_ = 0;
  std::uint64_t datagrams_ = 0;
};

}  // namespace skerry::pcap
