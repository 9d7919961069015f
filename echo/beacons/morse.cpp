#include "echo/beacons/morse.hpp"

namespace skerry::echo {
namespace {

constexpr std::array<std::string_view, 26> kLetters = {
    ".-",   "-...", "-.-.", "-..",  ".",   "..-.", "--.",  "....", "..",
    ".---", "-.-",  ".-..", "--",   "-.",  "---",  ".--.", "--.-", ".-.",
    "...",  "-",    "..-",  "...-", ".--", "-..-", "-.--", "--.."};

constexpr std::uint32_t kDash = 3, kLetterGap = 3;
constexpr std::size_t kMostLetters = 4;

}  // namespace

std::string_view morse_of(char letter) {
  if (letter < 'A' || letter > 'Z') return {};
  return kLetters[static_cast<std::size_t>(letter - 'A')];
}

MorseMarks marks_of(std::string_view code) {
  MorseMarks out;
  if (code.empty() || code.size() > kMostLetters) return out;
  std::uint32_t at = 0;
  for (const char letter : code) {
    const std::string_view morse = morse_of(letter);
    if (morse.empty()) return {};
    if (out.count > 0) at += kLetterGap - 1;  // one is there already, after the last mark
    for (const char mark : morse) {
      const std::uint32_t length = mark == '-' ? kDash : 1;
      out.marks[out.count++] = {static_cast<std::uint8_t>(at),
                                static_cast<std::uint8_t>(at + length)};
      out.dots = at + length;
      at += length + 1;
    }
  }
  return out;
}

}  // namespace skerry::echo
