// Integers of either byte order: appended to bytes, put to and read from places in bytes that are
// there, and read from bytes from outside with every bound checked.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

// Puts the low `octets` bytes of `value` to `at`.  These four require at + octets <= bytes.size().
constexpr void put_big_endian(std::span<std::uint8_t> bytes, std::size_t at, std::uint64_t value,
                              std::size_t octets) {
  for (std::size_t i = octets; i-- > 0; value >>= 8) {
    bytes[at + i] = static_cast<std::uint8_t>(value);
  }
}
constexpr void put_little_endian(std::span<std::uint8_t> bytes, std::size_t at, std::uint64_t value,
                                 std::size_t octets) {
  for (std::size_t i = 0; i < octets; ++i, value >>= 8) {
    bytes[at + i] = static_cast<std::uint8_t>(value);
  }
}

// What stands at `at`.  `octets` may be fewer than T has.
template <std::unsigned_integral T>
constexpr T big_endian_at(std::span<const std::uint8_t> bytes, std::size_t at,
                          std::size_t octets = sizeof(T)) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < octets; ++i) value = value << 8 | bytes[at + i];
  return static_cast<T>(value);
}
template <std::unsigned_integral T>
constexpr T little_endian_at(std::span<const std::uint8_t> bytes, std::size_t at,
                             std::size_t octets = sizeof(T)) {
  std::uint64_t value = 0;
  for (std::size_t i = octets; i-- > 0;) value = value << 8 | bytes[at + i];
  return static_cast<T>(value);
}

// Runs of 16-bit values, the least significant byte first.
inline void append_little_endian(Bytes& out, std::span<const std::uint16_t> values) {
  if constexpr (std::endian::native == std::endian::little) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    out.insert(out.end(), first, first + values.size_bytes());
  } else {
    for (const std::uint16_t value : values) append_little_endian(out, value, 2);
  }
}
// Requires bytes.size() == 2 * values.size().
inline void read_little_endian(std::span<const std::uint8_t> bytes,
                               std::span<std::uint16_t> values) {
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = little_endian_at<std::uint16_t>(bytes, 2 * i);
    }
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
    const auto taken = take(octets);
    return big_endian_at<T>(taken, 0, taken.size());
  }
  template <std::unsigned_integral T>
  constexpr T little_endian(std::size_t octets = sizeof(T)) {
    const auto taken = take(octets);
    return little_endian_at<T>(taken, 0, taken.size());
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
