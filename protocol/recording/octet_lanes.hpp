// Lanes: sixteen octets that are worked on at once, by whatever the processor has for that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace skerry::recording {

inline constexpr std::size_t kLanes = 16;
using Lanes = std::uint8_t __attribute__((vector_size(kLanes)));

inline Lanes load_lanes(const std::uint8_t* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, kLanes);
  return lanes;
}
inline void store_lanes(const Lanes& lanes, std::uint8_t* to) { std::memcpy(to, &lanes, kLanes); }

inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes greatest(Lanes a, Lanes b) { return a > b ? a : b; }

// Every lane moves on by one; the first becomes that of `first`.
inline Lanes moved_on(Lanes lanes, Lanes first) {
  // Zeros come in first: compilers know that as one instruction.
  const Lanes moved =
      __builtin_shufflevector(lanes, Lanes{}, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14);
  return moved | (first & Lanes{0xFF});
}

// Rows become columns.
inline void transpose_square(std::array<Lanes, kLanes>& square) {
  // To interleave row i with row i + 8 turns the eight bits of each octet's place (row, lane) by
  // one; four times exchanges row and lane.
  for (int turn = 0; turn < 4; ++turn) {
    std::array<Lanes, kLanes> turned;
    for (std::size_t i = 0; i < kLanes / 2; ++i) {
      const Lanes a = square[i], b = square[i + kLanes / 2];
      turned[2 * i] =
          __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
      turned[2 * i + 1] = __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13,
                                                  29, 14, 30, 15, 31);
    }
    square = turned;
  }
}

}  // namespace skerry::recording
