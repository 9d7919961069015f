#include "server/config/config_error.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "server/config/yaml_source.hpp"

namespace skerry::server {
namespace {

TEST(ConfigError, NamesFilePlacePathAndText) {
  EXPECT_STREQ(ConfigError("a.yaml", {12, 10}, "ships[0].rpm", "75 is out of range").what(),
               "a.yaml:12:10: ships[0].rpm: 75 is out of range");
  EXPECT_STREQ(ConfigError("a.yaml", {1, 1}, "", "not YAML").what(), "a.yaml:1:1: not YAML");
  EXPECT_STREQ(ConfigError("a\n.yaml", {1, 1}, "", "x").what(), "a\\x0a.yaml:1:1: x");
}

TEST(PrintableText, KeepsTextAndSpellsOutControlsAndWhatIsNotUtf8) {
  EXPECT_EQ(printable("S\xC3\xB8rn 1"), "S\xC3\xB8rn 1");
  EXPECT_EQ(printable("a\x1b[2J\n\x7f"), "a\\x1b[2J\\x0a\\x7f");
  EXPECT_EQ(printable("\xC2\x85|\xC2\xA0"), "\\xc2\\x85|\xC2\xA0");
  EXPECT_EQ(printable("\xFFz\xC3"), "\\xffz\\xc3");
  EXPECT_EQ(printable(std::string_view("\0x", 2)), "\\x00x");
}

TEST(PrintableText, DoesNotLookBeyondItsText) {
  // The byte behind makes the last one a letter, or a control character.
  EXPECT_EQ(printable(std::string_view("\xC2\xA9", 1)), "\\xc2");
  EXPECT_EQ(printable(std::string_view("\xC2\x85", 1)), "\\xc2");
}

TEST(PrintableText, IsCutAtACharactersBorder) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable("abcde\xC3\xB8g", 6), "abcde\xC3\xB8...");
}

// Against the code points themselves: every one is encoded and must be read at its length, and
// surrogates, overlong forms and what lies above U+10FFFF refused.
TEST(Utf8, AcceptsEveryCodePointInItsShortestFormAndNoOther) {
  const auto encoded = [](std::uint32_t code, int bytes) {
    constexpr std::uint32_t kLead[] = {0, 0x00, 0xC0, 0xE0, 0xF0};
    std::string text(static_cast<std::size_t>(bytes), '\0');
    for (int i = bytes - 1; i > 0; --i, code >>= 6) {
      text[static_cast<std::size_t>(i)] = static_cast<char>(0x80 | (code & 0x3F));
    }
    text[0] = static_cast<char>(kLead[bytes] | code);
    return text;
  };
  for (std::uint32_t code = 0; code < 0x200000; ++code) {
    const int shortest = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    const bool exists = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    ASSERT_EQ(utf8_length(encoded(code, shortest), 0),
              exists ? static_cast<std::size_t>(shortest) : 0u)
        << code;
    for (int overlong = shortest + 1; overlong <= 4; ++overlong) {
      ASSERT_EQ(utf8_length(encoded(code, overlong), 0), 0u) << code;
    }
    if (shortest > 1) {
      ASSERT_EQ(utf8_length(encoded(code, shortest).substr(0, shortest - 1u), 0), 0u) << code;
    }
  }
}

TEST(YamlSource, PlacesWhatTheFileLeavesOutInWhatIsAroundIt) {
  YamlSource source("a.yaml");
  source.add("", {1, 1});
  source.add("ships", {2, 3});
  source.add("ships[0]", {3, 5});
  source.add("ships[0].name", {3, 11});
  const auto line = [&](const char* path) { return source.place_of(path).line; };
  EXPECT_EQ(source.place_of("ships[0].name").column, 11);
  EXPECT_EQ(source.place_of("ships[0].radars[1].rpm").column, 5);
  EXPECT_EQ(line("ships[7].name"), 2);
  EXPECT_EQ(line("targets[0].name"), 1);
  EXPECT_TRUE(source.has("ships[0].name"));
  EXPECT_FALSE(source.has("ships[0].beam_m"));
  EXPECT_STREQ(source.error("ships[0].beam_m", "missing").what(),
               "a.yaml:3:5: ships[0].beam_m: missing");
}

}  // namespace
}  // namespace skerry::server
