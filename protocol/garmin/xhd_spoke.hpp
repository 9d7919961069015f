// The video of Garmin xHD radars: one spoke a datagram.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::garmin {

inline constexpr std::size_t kSpokeHeaderBytes = 36;
inline constexpr std::size_t kMaxCells = 705;
// Cells of the capture's radar; garmin/README.md has another with 695.
inline constexpr std::uint32_t kCells = 698;
// 698 cells span 2093 m at a range of 1852 m.  Source: garminxhd_txon_txoff.pcap.gz;
// garmin/README.md rounds it to 1.125.
inline constexpr double kSpanOfRange = 2093.0 / 1852.0;

struct SpokePacket {
  std::uint16_t angle = 0;              // of kAnglesPerTurn, clockwise from the bow
  std::uint32_t range_m = 0;            // what the display is set to
  std::uint32_t span_m = 0;             // where the last cell ends
  std::span<const std::uint8_t> cells;  // 0 .. 255, nearest first; a part of the datagram
};
// Error: truncated, oversized, unknown_kind (no spoke), out_of_range (angle, more than kMaxCells),
// malformed (its lengths contradict each other).
Result<SpokePacket, WireError> decode_spoke(std::span<const std::uint8_t> datagram);
// Requires at most kMaxCells.
void append_spoke(Bytes& out, const SpokePacket& spoke);

}  // namespace skerry::garmin
