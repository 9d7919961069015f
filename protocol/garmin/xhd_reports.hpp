// Reports of a Garmin xHD radar about itself, sent in a round that repeats.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/garmin/xhd_packet.hpp"

namespace skerry::garmin {

// Reports leave at ticks of 10 ms, one at each, in a round of two seconds.
inline constexpr std::uint32_t kTickMs = 10;
inline constexpr std::uint32_t kTicksPerRound = 200;

// A report leaves at every tick that is `tick` modulo `period`.
struct ReportSlot {
  std::uint32_t type = 0;
  std::uint8_t octets = 0;  // of its number
  std::uint8_t tick = 0;
  std::uint8_t period = 0;   // ticks: 10, 50 or 200
  std::uint32_t number = 0;  // in the capture, before a display asked for anything
};
// Every report that is a number, by tick.  Source: garminxhd_txon_txoff.pcap.gz; a report that
// answers a command is sent besides.
std::span<const ReportSlot> report_slots();

// The two reports of a round that are no numbers.
inline constexpr std::uint32_t kAbilitiesType = 0x9b1, kRangesType = 0x9b2;
inline constexpr std::uint32_t kAbilitiesTick = 85, kRangesTick = 86;
Bytes encode_abilities();  // bits of unknown meaning, as captured
Bytes encode_ranges();     // kRanges

// The ranges a display may choose, m.
inline constexpr std::array<std::uint32_t, 16> kRanges = {232,   463,   926,   1389,  1852,  2778,
                                                          3704,  5556,  7408,  11112, 14816, 22224,
                                                          29632, 44448, 66672, 88896};

// Every kHeartbeatSeconds to kHeartbeatAddress; what it tells but for its count is unknown.
inline constexpr int kHeartbeatSeconds = 5;
inline constexpr std::uint32_t kHeartbeatTick = 67;  // of the first
Bytes encode_heartbeat(std::uint16_t count);

}  // namespace skerry::garmin
