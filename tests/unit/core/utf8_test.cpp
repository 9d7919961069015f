#include "server/core/utf8.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace skerry::server {
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

}  // namespace
}  // namespace skerry::server
