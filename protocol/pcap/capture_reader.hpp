// Captures of network traffic (pcap, pcapng): the UDP datagrams in them, IPv4 fragments put
// together.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::pcap {

struct Datagram {
  UtcTime time;  // of its last fragment
  Ipv4Endpoint from;
  Ipv4Endpoint to;
  std::span<const std::uint8_t> payload;  // valid during the call only
};

struct CaptureCounts {
  std::uint64_t frames = 0;
  std::uint64_t datagrams = 0;   // UDP over IPv4, whole
  std::uint64_t incomplete = 0;  // of which fragments are missing, or frames cut short
  std::uint64_t others = 0;      // frames that are no UDP over IPv4
};

// Calls `sink` with every datagram in the order of the capture.  Reads pcap (micro- and
// nanoseconds, either byte order) and pcapng; Ethernet (with VLAN tags), Linux cooked, loopback and
// raw IP links. At most kMaxPending datagrams wait for fragments; the oldest are given up. Error:
// what is wrong with the file and at which byte; datagrams before it have been given.
inline constexpr std::size_t kMaxPending = 256;
Result<CaptureCounts, WireError> read_capture(std::span<const std::uint8_t> file,
                                              const std::function<void(const Datagram&)>& sink);

// The same of a file, which may be packed by gzip: it is unpacked on the way, so that memory does
// not grow with it.  `progress` (may be empty) gets the share read, 0 .. 1, and may return false to
// give up.  Error: as above, at the byte of the unpacked file; or it cannot be opened or read.
Result<CaptureCounts, WireError> read_capture_file(
    const std::string& path, const std::function<void(const Datagram&)>& sink,
    const std::function<bool(double)>& progress = {});

}  // namespace skerry::pcap
