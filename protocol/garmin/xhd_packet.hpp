// The network protocol of Garmin xHD radars: packets of a type and a number.  README.md tells what
// every type is, as far as it is known.  Source: garmin/README.md, garminxhd_txon_txoff.pcap.gz.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::garmin {

inline constexpr Ipv4Endpoint kReportAddress{ipv4(239, 254, 2, 0), 50100};
inline constexpr Ipv4Endpoint kSpokeAddress{ipv4(239, 254, 2, 0), 50102};
inline constexpr Ipv4Endpoint kHeartbeatAddress{ipv4(239, 254, 2, 2), 50050};
inline constexpr std::uint16_t kCommandPort = 50101;  // unicast to where the reports come from

// Types with a known meaning.  A radar reports all of them but `old_rejection`; those that a
// display may send are in find_command().
enum class Type : std::uint32_t {
  old_rejection = 0x2b9,  // interference rejection, as older displays send it
  heartbeat = 0x38e,
  speed = 0x916,  // 0 normal, 1 fast
  transmit = 0x919,
  rejection = 0x91b,        // interference rejection
  gain_auto_level = 0x91d,  // 0 low, 1 high
  range = 0x91e,            // m
  gain_auto = 0x924,        // 0 by hand, 2 by itself
  gain = 0x925,             // percent * 100
  alignment = 0x930,        // degrees * 32
  crosstalk = 0x932,        // interference rejection as well
  rain_on = 0x933,
  rain = 0x934,            // percent * 100
  sea_mode = 0x939,        // 0 off, 1 by hand, 2 by itself
  sea = 0x93a,             // percent * 100
  sea_auto_level = 0x93b,  // 0 calm .. 2 rough
  no_transmit_on = 0x93f,
  no_transmit_from = 0x940,  // degrees * 32, from the bow, signed
  no_transmit_to = 0x941,
  timed_on = 0x942,
  timed_idle = 0x943,  // s
  timed_run = 0x944,   // s
  scanner_state = 0x992,
  until_change = 0x993,  // ms to the next scanner state
  rotation = 0x994,      // rpm * 100, measured
  antenna = 0x995,       // where it points, of kAnglesPerTurn
  last_spoke = 0x996,    // the last one sent, of kAnglesPerTurn
  spoke = 0x998,
};

enum class ScannerState : std::uint8_t {
  warming_up = 2,
  standby = 3,
  spinning_up = 4,
  transmitting = 5,
  stopping = 6,
  spinning_down = 7,
  starting = 10,
};

// Angles of spokes are clockwise from the bow; a radar sends every eighth.
inline constexpr std::uint32_t kAnglesPerTurn = 11520;
inline constexpr std::uint32_t kSpokesPerTurn = 1440;

// One packet of any type; `payload` is a part of the datagram.
struct Packet {
  std::uint32_t type = 0;
  std::span<const std::uint8_t> payload;

  bool is(Type known) const { return type == static_cast<std::uint32_t>(known); }
  // The number in a payload of 1, 2 or 4 bytes.
  std::optional<std::uint32_t> number() const;
  std::optional<std::int32_t> signed_number() const;
};
// Error: truncated or oversized where the length it tells is not that of the datagram.
Result<Packet, WireError> decode_packet(std::span<const std::uint8_t> datagram);

// A packet of one number of 1, 2 or 4 bytes, negative ones in two's complement.
Bytes encode_packet(Type type, int octets, std::int64_t number);
Bytes encode_packet(std::uint32_t type, std::span<const std::uint8_t> payload);

// Values that a display may set.  Source: garmin/README.md.
struct CommandRange {
  Type type;
  std::int64_t least;
  std::int64_t greatest;
};
const CommandRange* find_command(std::uint32_t type);  // nullptr: not a command

// A display's wish.  `value` is within find_command()'s range: what lay outside was clamped.
struct Command {
  Type type = Type::transmit;
  std::int64_t value = 0;
  bool clamped = false;
};
// Error: of decode_packet(); unknown_kind for types that are no command; malformed for payloads
// that are no number.
Result<Command, WireError> decode_command(std::span<const std::uint8_t> datagram);

}  // namespace skerry::garmin
