// Raymarine E-120 displays with analogue scanners (RD), read only: the video and state of such a
// radar.  Source: raymarine/README.md, raymarine-e120-analog-tx-stdby.pcap.gz, mayara
// docs/raymarine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

inline constexpr std::uint32_t kRdStatusType = 0x010001, kRdSpokesType = 0x010003;
inline constexpr std::uint32_t kRdSpokes = 2048;  // per turn
inline constexpr std::size_t kRdCells = 512;      // of 4 bits, low nibble nearer on the wire

struct RdSpoke {
  std::uint32_t azimuth = 0;        // 0 .. kRdSpokes-1
  std::vector<std::uint8_t> cells;  // kRdCells, nearest first, 0 .. 15; they reach twice the range
};
// Error: truncated, unknown_kind (no spokes, or those of HD scanners, which have 8 bits),
// malformed, out_of_range (azimuth), oversized (too many cells).
Result<std::vector<RdSpoke>, WireError> decode_rd_spokes(std::span<const std::uint8_t> datagram);

inline constexpr std::size_t kRdRanges = 11;
enum class RdState : std::uint8_t { standby = 0, transmit = 1, warming_up = 2, off = 3 };
struct RdStatus {
  std::array<std::uint32_t, kRdRanges> ranges{};  // 1/1000 NM each
  std::uint8_t state = 0;                         // RdState, or another
  std::uint8_t warm_up_s = 0;
  std::uint8_t signal_bars = 0;
  std::uint8_t range_index = 0;  // of `ranges`
  // Nominal; 0 where the table has none.
  double range_m() const { return ranges[range_index] * 1.852; }
};
// Error: truncated, unknown_kind, out_of_range (range index).
Result<RdStatus, WireError> decode_rd_status(std::span<const std::uint8_t> datagram);

}  // namespace skerry::raymarine
