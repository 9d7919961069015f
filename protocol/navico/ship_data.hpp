// Own ship's motion on a HALO's network: heading, navigation and speed packets.
// Source: navico/README.md.  None of them is in a recording: what is not described there is zero,
// but for the octets that begin and number an 'NKOE' packet.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::navico {

inline constexpr std::size_t kShipOctets = 72, kSpeedOctets = 23;

struct HeadingPacket {
  std::uint16_t counter = 0;
  double heading_deg = 0.0;  // true, [0, 360); in steps of 1e-4 rad
  friend bool operator==(const HeadingPacket&, const HeadingPacket&) = default;
};
struct NavigationPacket {
  std::uint16_t counter = 0;
  double course_deg = 0.0;  // over ground, in steps of 1e-4 rad
  double speed_mps = 0.0;   // over ground, in steps of 0.01, at most 655.35
  friend bool operator==(const NavigationPacket&, const NavigationPacket&) = default;
};
struct SpeedPacket {
  double speed_mps = 0.0;   // over ground, in steps of 0.1
  double course_deg = 0.0;  // over ground, in steps of 0.1
  friend bool operator==(const SpeedPacket&, const SpeedPacket&) = default;
};

// Values outside their range are brought into it.
Bytes encode(const HeadingPacket& packet);
Bytes encode(const NavigationPacket& packet);
Bytes encode(const SpeedPacket& packet);

// Error: truncated, oversized, unknown_kind or out_of_range (an angle of a turn or more).
Result<std::variant<HeadingPacket, NavigationPacket, SpeedPacket>, WireError> decode_ship_packet(
    std::span<const std::uint8_t> datagram);

}  // namespace skerry::navico
