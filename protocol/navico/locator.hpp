// The locator: how displays find a Navico radar and its multicast groups.  Source:
// navico/README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::navico {

// Display -> group: 01B1, "who is there?"
Bytes encode_locator_question();
bool is_locator_question(std::span<const std::uint8_t> datagram);

// Radar -> group: 01B2.  All of its octets are known: a list of services, each with the groups it
// uses.  Service 0x10, instance 1 and 2, is the picture of range A and B.
inline constexpr std::uint16_t kPictureService = 0x0010;
enum class LocatorRole : std::uint16_t { data = 0x10, send = 0x11, report = 0x12 };
struct LocatorGroup {
  std::uint16_t role = 0;
  Ipv4Endpoint at;
  friend bool operator==(const LocatorGroup&, const LocatorGroup&) = default;
};
struct LocatorService {
  std::uint16_t kind = 0;
  std::uint8_t instance = 1;
  std::vector<LocatorGroup> groups;
  friend bool operator==(const LocatorService&, const LocatorService&) = default;
};
struct Locator {
  std::string serial;  // at most 16 characters
  Ipv4Endpoint radar;
  std::vector<LocatorService> services;
  friend bool operator==(const Locator&, const Locator&) = default;

  // The groups of range A (1) or B (2), if the radar has it.
  std::optional<Addresses> find_picture(std::uint8_t instance) const;
};
inline constexpr std::size_t kMaxLocator = 1500;

Bytes encode_locator(const Locator& locator);
// Error: truncated, oversized, unknown_kind (not 01B2) or malformed.
Result<Locator, WireError> decode_locator(std::span<const std::uint8_t> datagram);

// The locator of a radar with one picture, or two.  150 octets with one, 222 with two: displays
// tell them apart by length.
Locator make_locator(std::string serial, Ipv4Endpoint radar, const Addresses& a,
                     const std::optional<Addresses>& b);

}  // namespace skerry::navico
