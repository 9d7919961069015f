// The run-length code of Raymarine's video: 0x5C, count, value; any other byte is itself.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

inline constexpr std::uint8_t kRunMark = 0x5C;
// Shorter runs stand as they are (but of the mark itself).  Source: all 27,656 spokes of
// quantum2-solent-03-gain-sea-rain.pcap.gz come back byte by byte.
inline constexpr std::size_t kShortestRun = 4;

// Error: truncated in the middle of a run; oversized where it would be more than `most` bytes.
Result<Bytes, WireError> decode_runs(std::span<const std::uint8_t> coded, std::size_t most);
void append_runs(Bytes& out, std::span<const std::uint8_t> plain);

}  // namespace skerry::raymarine
