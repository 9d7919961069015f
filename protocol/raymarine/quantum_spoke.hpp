// The video of Raymarine Quantum radars: one spoke a datagram, run-length coded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

inline constexpr std::uint32_t kQuantumSpokes = 250;  // per turn
inline constexpr std::size_t kQuantumMaxCells = 252;
// Cells of the capture's radar; they reach 231 / 103 times the range.
inline constexpr std::uint16_t kQuantumCells = 231, kQuantumCellsPerRange = 103;
// The highest echo; above are the colours of a Doppler radar.  Source: mayara docs/raymarine.
inline constexpr std::uint8_t kQuantumStrongest = 253, kQuantumReceding = 254,
                              kQuantumApproaching = 255;

struct QuantumSpoke {
  std::uint16_t sequence = 0;         // +1 every spoke
  std::uint16_t cells_per_range = 0;  // the range of the status is at this cell
  std::uint16_t azimuth = 0;          // 0 .. kQuantumSpokes-1, clockwise from the STERN
  std::vector<std::uint8_t> cells;    // nearest first
};
// Short video is filled with zeros, as displays take it.
// Error: truncated, unknown_kind (no spoke), out_of_range, malformed, oversized (too many cells).
Result<QuantumSpoke, WireError> decode_quantum_spoke(std::span<const std::uint8_t> datagram);
// Requires at most kQuantumMaxCells.
void append_quantum_spoke(Bytes& out, const QuantumSpoke& spoke);

}  // namespace skerry::raymarine
