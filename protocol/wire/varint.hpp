// Varints, as in protobuf: an unsigned number in groups of 7 bits, the lowest group first, one
// group to an octet; bit 7 of an octet is set if another follows.  0 is one octet, 32 bits take at
// most 5, 64 bits 10.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry {

inline constexpr std::size_t kMaxVarint32Octets = 5;
inline constexpr std::size_t kMaxVarintOctets = 10;

// Returns the place behind the last octet.  Requires kMaxVarintOctets octets at `out`.
constexpr std::uint8_t* write_varint(std::uint8_t* out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) *out++ = static_cast<std::uint8_t>(value | 0x80);
  *out++ = static_cast<std::uint8_t>(value);
  return out;
}

inline void append_varint(Bytes& out, std::uint64_t value) {
  std::uint8_t octets[kMaxVarintOctets];
  out.insert(out.end(), octets, write_varint(octets, value));
}

struct Varint {
  std::uint64_t value = 0;
  std::size_t octets = 0;  // 0: none was read
};

// The varint at the front of `in`; none if `in` ends before it does (truncated), or if octet number
// `longest` has bit 7 set (too long).  Octets may be more than the value needs; what a tenth holds
// beyond 64 bits is dropped.  Requires longest <= kMaxVarintOctets.
constexpr Varint read_varint(std::span<const std::uint8_t> in,
                             std::size_t longest = kMaxVarintOctets) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < in.size() && i < longest; ++i) {
    value |= std::uint64_t{in[i] & 0x7Fu} << 7 * i;
    if ((in[i] & 0x80) == 0) return {value, i + 1};
  }
  return {};
}

}  // namespace skerry
