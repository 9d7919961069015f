// Integers of either byte order: appending them to bytes, and reading them with every bound
// checked.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry {

// Appends the low `octets` bytes of `value`, the most significant first.
constexpr void append_big_endian(Bytes& out, std::uint64_t value, int octets) {
  for (int shift = 8 * (octets - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

// The same, the least significant first.
constexpr void append_little_endian(Bytes& out, std::uint64_t value, int octets) {
  for (int shift = 0; shift < 8 * octets; shift += 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

// A position in bytes from outside.  Reading beyond the end gives zeros and sets truncated(), so
// that a decoder may read several fields and ask once; an allocation or a loop asks first.
class ByteReader {
 public:
  explicit constexpr ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  // Requires an unsigned T.  `octets` may be fewer than T has.
  template <std::unsigned_integral T>
  constexpr T big_endian(std::size_t octets = sizeof(T)) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : take(octets)) value = value << 8 | byte;
    return static_cast<T>(value);
  }
  template <std::unsigned_integral T>
  constexpr T little_endian(std::size_t octets = sizeof(T)) {
    std::uint64_t value = 0;
    int shift = 0;
    for (const std::uint8_t byte : take(octets)) {
      value |= std::uint64_t{byte} << shift;
      shift += 8;
    }
    return static_cast<T>(value);
  }
  constexpr std::uint8_t octet() { return big_endian<std::uint8_t>(); }

  // The next `count` bytes; none, and truncated(), if there are fewer.
  constexpr std::span<const std::uint8_t> take(std::size_t count) {
    if (count > left()) {
      truncated_ = true;
      offset_ = bytes_.size();
      return {};
    }
    const auto taken = bytes_.subspan(offset_, count);
    offset_ += count;
    return taken;
  }

  constexpr std::size_t offset() const { return offset_; }
  constexpr std::size_t left() const { return bytes_.size() - offset_; }
  constexpr bool truncated() const { return truncated_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t offset_ = 0;
  bool truncated_ = false;
};

}  // namespace skerry
