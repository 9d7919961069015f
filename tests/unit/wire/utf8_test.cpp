#include "protocol/wire/utf8.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace skerry {
namespace {

char32_t first_of(std::string_view text) {
  const auto c = take_code_point(text);
  EXPECT_TRUE(c.has_value());
  EXPECT_EQ(text, "-");
  return c.value_or(0);
}

TEST(Utf8, TakesOneCodePointAtATime) {
  EXPECT_EQ(first_of("a-"), U'a');
  EXPECT_EQ(first_of("\xc2\x80-"), 0x80u);
  EXPECT_EQ(first_of("\xc3\xb8-"), U'\u00f8');
  EXPECT_EQ(first_of("\xe0\xa0\x80-"), 0x800u);
  EXPECT_EQ(first_of("\xef\xbf\xbf-"), 0xffffu);
  EXPECT_EQ(first_of("\xf0\x90\x80\x80-"), 0x10000u);
  EXPECT_EQ(first_of("\xf4\x8f\xbf\xbf-"), 0x10ffffu);
}

// Continuations alone, too long forms, surrogates, beyond the last, cut short (RFC 3629, 3 and 10).
TEST(Utf8, LeavesWhatIsNone) {
  for (const std::string_view wrong :
       {"\x80", "\xbf-", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80",
        "\xed\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xc3", "\xe2\x82",
        "\xf0\x90\x80", "\xc3(", "\xe2\x82("}) {
    std::string_view text = wrong;
    EXPECT_FALSE(take_code_point(text).has_value());
    EXPECT_EQ(text, wrong);
  }
}

// Against the code points themselves: every one is encoded and must be read, and surrogates,
// overlong forms and what lies above U+10FFFF refused.
TEST(Utf8, TakesEveryCodePointInItsShortestFormAndNoOther) {
  const auto encoded = [](std::uint32_t code, int bytes) {
    constexpr std::uint32_t kLead[] = {0, 0x00, 0xC0, 0xE0, 0xF0};
    std::string text(static_cast<std::size_t>(bytes), '\0');
    for (int i = bytes - 1; i > 0; --i, code >>= 6) {
      text[static_cast<std::size_t>(i)] = static_cast<char>(0x80 | (code & 0x3F));
    }
    text[0] = static_cast<char>(kLead[bytes] | code);
    return text;
  };
  const auto taken = [](std::string_view text) {
    const auto point = take_code_point(text);
    EXPECT_EQ(text.empty(), point.has_value());
    return point;
  };
  for (std::uint32_t code = 0; code < 0x200000; ++code) {
    const int shortest = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    const bool exists = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    ASSERT_EQ(taken(encoded(code, shortest)), exists ? std::optional<char32_t>(code) : std::nullopt)
        << code;
    for (int overlong = shortest + 1; overlong <= 4; ++overlong) {
      ASSERT_EQ(taken(encoded(code, overlong)), std::nullopt) << code;
    }
    if (shortest > 1) {
      ASSERT_EQ(taken(encoded(code, shortest).substr(0, shortest - 1u)), std::nullopt) << code;
    }
  }
}

TEST(Utf8, CountsCharacters) {
  EXPECT_EQ(character_count(""), 0u);
  EXPECT_EQ(character_count("Bj\xC3\xB8rn \xF0\x9F\x9A\xA2"), 7u);
}

}  // namespace
}  // namespace skerry
