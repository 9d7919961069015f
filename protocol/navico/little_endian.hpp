// Little-endian integers at fixed places of a Navico packet.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace skerry::navico {

// Require at + sizeof(T) (or `octets`) <= bytes.size().
template <std::unsigned_integral T>
constexpr T read_le(std::span<const std::uint8_t> bytes, std::size_t at,
                    std::size_t octets = sizeof(T)) {
  std::uint64_t value = 0;
  for (std::size_t i = octets; i-- > 0;) value = value << 8 | bytes[at + i];
  return static_cast<T>(value);
}

constexpr void write_le(std::span<std::uint8_t> bytes, std::size_t at, std::uint64_t value,
                        std::size_t octets) {
  for (std::size_t i = 0; i < octets; ++i, value >>= 8) {
    bytes[at + i] = static_cast<std::uint8_t>(value);
  }
}

}  // namespace skerry::navico
