// A font of 5 x 7 dots for the labels of a radar picture.
#pragma once

#include <array>
#include <cstdint>

namespace skerry::client {

inline constexpr int kGlyphColumns = 5;
inline constexpr int kGlyphRows = 7;

// Each row's five dots, the leftmost in bit 4.
struct Glyph {
  std::array<std::uint8_t, kGlyphRows> rows;
  constexpr bool dot(int column, int row) const {
    return ((rows[row] >> (kGlyphColumns - 1 - column)) & 1) != 0;
  }
};

// Digits, capitals and the punctuation of labels; lower case gets the capital's glyph, '^' the
// degree sign's, everything else a box.
const Glyph& glyph_of(char c);

}  // namespace skerry::client
