// CRC-32 as MCAP has it: that of Ethernet and zlib.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::recording {

// The CRC of `bytes`, continuing `before`, the CRC of the bytes before them; 0 before the first.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

}  // namespace skerry::recording
