// How a Raymarine Quantum radar makes itself known: three packets, each once a second, to a group
// that all of this maker's equipment uses.  Source: raymarine/README.md,
// quantum2-solent-03-gain-sea-rain.pcap.gz; README.md lists what is unknown in them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

inline constexpr Ipv4Endpoint kLocatorAddress{ipv4(224, 0, 0, 1), 5800};

// The identity that the packets of one device share, and its kind.
struct LocatorId {
  std::uint32_t link_id = 0;
  std::uint32_t model = 0;
};
inline constexpr std::uint32_t kQuantumModel = 0x28;   // in the packet of addresses
inline constexpr std::uint32_t kQuantumDevice = 0x66;  // in the packets of names
inline constexpr std::uint32_t kAnalogueModel = 0x01;  // E-120 and RD scanners

// 36 bytes: where its data go, and where it takes commands.
struct LocatorAddresses {
  LocatorId id;
  Ipv4Endpoint data;
  Ipv4Endpoint radar;
};
// Error: truncated, oversized, unknown_kind (not a locator's packet).
Result<LocatorAddresses, WireError> decode_locator_addresses(
    std::span<const std::uint8_t> datagram);
Bytes encode_locator_addresses(const LocatorAddresses& addresses);

// 56 bytes: what it is called.
struct LocatorName {
  LocatorId id;
  std::string name;  // at most 32 characters
};
// Error: as above.
Result<LocatorName, WireError> decode_locator_name(std::span<const std::uint8_t> datagram);
Bytes encode_locator_name(const LocatorName& name);

// 70 bytes: the same, with where it takes commands.
Bytes encode_locator_long_name(const LocatorName& name, const Ipv4Endpoint& radar);

}  // namespace skerry::raymarine
