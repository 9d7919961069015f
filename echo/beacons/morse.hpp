// Morse: what a racon writes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace skerry::echo {

// Dots and dashes of a letter A to Z; empty for anything else.  Source: ITU-R M.1677 (international
// Morse code).
std::string_view morse_of(char letter);

// A code of 1 to 4 letters as marks of light and dark, in dots from its beginning: a dot is 1, a
// dash 3, the gap between marks 1 (SOURCES.md "Beacons"), between letters 3.
struct MorseMarks {
  struct Mark {
    std::uint8_t from = 0, to = 0;
  };
  static constexpr std::size_t kMost = 16;  // 4 letters of 4 marks
  std::array<Mark, kMost> marks = {};
  std::uint32_t count = 0;
  std::uint32_t dots = 0;  // in all
};

// Empty (count 0) unless `code` is 1 to 4 letters A to Z.
MorseMarks marks_of(std::string_view code);

}  // namespace skerry::echo
