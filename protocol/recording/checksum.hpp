// CRC-32 as MCAP has it: that of Ethernet and zlib.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::recording {

// Of `bytes` after those of which `before` is the sum; 0 before the first.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

}  // namespace skerry::recording
