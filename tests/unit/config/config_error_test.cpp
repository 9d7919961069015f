#include "server/config/config_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

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
}

std::string all_errors(const YamlSource& source) {
  try {
    source.require_sound();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(YamlSource, ListsAllErrorsInTheOrderOfTheTextWithTheirNumber) {
  YamlSource source("a.yaml");
  EXPECT_EQ(all_errors(source), "");
  source.add("", {1, 1});
  source.add("ships[0]", {3, 5});
  source.refuse("ships[0].beam_m", "missing");
  EXPECT_EQ(all_errors(source), "a.yaml:3:5: ships[0].beam_m: missing");
  source.complain("no tags", {2, 9});
  source.refuse("ships[0].x", "unknown", {3, 5});
  source.refuse("ships[0].y", "unknown", {3, 4});
  EXPECT_EQ(all_errors(source),
            "a.yaml:2:9: no tags\na.yaml:3:4: ships[0].y: unknown\n"
            "a.yaml:3:5: ships[0].beam_m: missing\na.yaml:3:5: ships[0].x: unknown\n"
            "a.yaml: 4 errors");
  try {
    source.fail("not YAML", {1, 2});
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 22), "a.yaml:1:2: not YAML\na");
  }
}

TEST(YamlSource, ShowsTheFirstHundredErrorsAndCountsTheOthers) {
  YamlSource source("a.yaml");
  for (int line = 123; line > 0; --line) source.complain("wrong", {line, 1});
  const std::string all = all_errors(source);
  EXPECT_EQ(all.substr(0, 20), "a.yaml:1:1: wrong\na.");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 100);
  const std::string end = "a.yaml:100:1: wrong\na.yaml: 123 errors: 100 shown and 23 more";
  EXPECT_EQ(all.substr(all.size() - end.size()), end);
}

TEST(YamlSource, IsNotSoundAtInAndAroundWhatWasRefused) {
  YamlSource source("a.yaml");
  source.complain("no tags", {1, 1});
  EXPECT_TRUE(source.is_sound(""));
  source.refuse("ships[0].radars[1].rpm", "75");
  for (const char* path : {"", "ships", "ships[0]", "ships[0].radars", "ships[0].radars[1]",
                           "ships[0].radars[1].rpm", "ships[0].radars[1].rpm[2].x"}) {
    EXPECT_FALSE(source.is_sound(path)) << path;
  }
  for (const char* path : {"ship", "ships[1]", "ships[0].radars[1].rp", "ships[0].radars[1].rpms",
                           "ships[0].radar", "ships[0].name"}) {
    EXPECT_TRUE(source.is_sound(path)) << path;
  }
}

}  // namespace
}  // namespace skerry::server
