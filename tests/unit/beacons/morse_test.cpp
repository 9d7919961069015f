#include "echo/beacons/morse.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace skerry::echo {
namespace {

// The code drawn in dots, '#' for light.
std::string drawn(std::string_view code) {
  const MorseMarks marks = marks_of(code);
  std::string out(marks.dots, ' ');
  for (std::uint32_t i = 0; i < marks.count; ++i)
    for (std::uint32_t at = marks.marks[i].from; at < marks.marks[i].to; ++at) out[at] = '#';
  return out;
}

TEST(Morse, LettersAreThoseOfTheInternationalCode) {
  EXPECT_EQ(morse_of('E'), ".");
  EXPECT_EQ(morse_of('T'), "-");
  EXPECT_EQ(morse_of('K'), "-.-");
  EXPECT_EQ(morse_of('D'), "-..");  // new dangers
  EXPECT_EQ(morse_of('Q'), "--.-");
  EXPECT_EQ(morse_of('S'), "...");
  EXPECT_EQ(morse_of('O'), "---");
}

TEST(Morse, AllLettersDifferAndHaveUpToFourMarks) {
  std::set<std::string_view> seen;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    const std::string_view morse = morse_of(letter);
    EXPECT_GE(morse.size(), 1u) << letter;
    EXPECT_LE(morse.size(), 4u) << letter;
    EXPECT_TRUE(seen.insert(morse).second) << letter;
  }
}

TEST(Morse, ADashIsThreeDotsAndAGapOne) {
  EXPECT_EQ(drawn("K"), "### # ###");
  EXPECT_EQ(drawn("D"), "### # #");
  EXPECT_EQ(drawn("E"), "#");
  EXPECT_EQ(drawn("ET"), "#   ###");
  EXPECT_EQ(marks_of("YYYY").count, MorseMarks::kMost);
}

TEST(Morse, WhatIsNoCodeHasNoMarks) {
  for (const char* code : {"", "k", "K1", "ABCDE", "A B", "\xC3\x84"})
    EXPECT_EQ(marks_of(code).count, 0u) << code;
  EXPECT_TRUE(morse_of('a').empty());
  EXPECT_TRUE(morse_of('@').empty());
  EXPECT_TRUE(morse_of('[').empty());
}

}  // namespace
}  // namespace skerry::echo
