// Little-endian integers in a header of fixed size, at offsets; and runs of 16-bit values.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry::board {

// Requires offset + sizeof(T) <= bytes.size().
template <std::unsigned_integral T>
constexpr void put_little_endian(std::span<std::uint8_t> bytes, std::size_t offset, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[offset + i] = static_cast<std::uint8_t>(std::uint64_t{value} >> 8 * i);
  }
}

template <std::unsigned_integral T>
constexpr T get_little_endian(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value |= std::uint64_t{bytes[offset + i]} << 8 * i;
  }
  return static_cast<T>(value);
}

inline void append_values(Bytes& out, std::span<const std::uint16_t> values) {
  if constexpr (std::endian::native == std::endian::little) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    out.insert(out.end(), first, first + values.size_bytes());
  } else {
    for (const std::uint16_t value : values) {
      out.push_back(static_cast<std::uint8_t>(value & 0xFF));
      out.push_back(static_cast<std::uint8_t>(value >> 8));
    }
  }
}

// Requires bytes.size() == 2 * values.size().
inline void read_values(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> values) {
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = get_little_endian<std::uint16_t>(bytes, 2 * i);
    }
  }
}

}  // namespace skerry::board
