// Records whose every byte follows from their sequence, so that one torn byte shows.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"

namespace skerry::board {

using RingState = SweepRingReader::State;

inline constexpr std::size_t kRingBytes = kRingHeader + kLeastRingCapacity;

// A record as an encoder makes it; between header and end only the size counts.
inline Bytes ring_record(std::uint64_t sequence, std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t mixed = (sequence * 0x9E37'79B9'7F4A'7C15 + i / 8) * 0xD6E8'FEB8'6659'FD93;
    bytes[i] = static_cast<std::uint8_t>(mixed >> (8 * (i % 8)));
  }
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(size >> 8 * i);
  bytes[4] = 1;
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[8 + i] = static_cast<std::uint8_t>(sequence >> 8 * i);
  }
  return bytes;
}

// Sizes of many lengths: 64 .. 65536 bytes.
inline std::size_t ring_record_size(std::uint64_t sequence) {
  return 64 * (1 + (sequence * 2'654'435'761u >> 7) % 1024);
}

inline bool is_ring_record(std::span<const std::uint8_t> bytes, std::size_t size) {
  const auto prefix = record_prefix(bytes);
  if (!prefix || bytes.size() != size) return false;
  const Bytes expected = ring_record(prefix->sequence, size);
  return std::equal(bytes.begin(), bytes.end(), expected.begin(), expected.end());
}

}  // namespace skerry::board
