// Values of each type: what is taken, what is refused and with which words.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "tests/unit/config/loading.hpp"

namespace skerry::server {
namespace {

TEST(YamlValues, OfEveryTypeAreRead) {
  const test::EveryKind all = loaded(
      "bounded: -1.5e0\nat_least: +2\nat_most: .5\nnumber: -1e-300\ncount: 8192\nchoice: 4\n"
      "whole: 4294967295\nbig: 18446744073709551615\nflag: false\ntext: S\xC3\xB8r 1\n"
      "numbers: [1, -2.5, 10]\nwords:\n- a b\n- 'c'\n- \"\\u00e9\"\n"
      "parts: [{name: x}, {name: y, width_m: 80}]\npart: {name: z}\nscale: 0.125\n");
  EXPECT_EQ(all.bounded(), -1.5);
  EXPECT_EQ(all.at_least(), 2.0);
  EXPECT_EQ(all.at_most(), 0.5);
  EXPECT_EQ(all.number(), -1e-300);
  EXPECT_EQ(all.count(), 8192u);
  EXPECT_EQ(all.choice(), 4u);
  EXPECT_EQ(all.whole(), 4294967295u);
  EXPECT_EQ(all.big(), 18446744073709551615u);
  EXPECT_FALSE(all.flag());
  EXPECT_EQ(all.text(), "S\xC3\xB8r 1");
  ASSERT_EQ(all.numbers_size(), 3);
  EXPECT_EQ(all.numbers(1), -2.5);
  ASSERT_EQ(all.words_size(), 3);
  EXPECT_EQ(all.words(2), "\xC3\xA9");
  ASSERT_EQ(all.parts_size(), 2);
  EXPECT_EQ(all.parts(0).width_m(), 1.5);
  EXPECT_EQ(all.parts(1).width_m(), 80.0);
  EXPECT_EQ(all.part().name(), "z");
  EXPECT_EQ(all.scale(), 0.125);
}

TEST(YamlValues, AbsentKeysGetTheirDefault) {
  const test::EveryKind all = loaded("text: only\n");
  EXPECT_EQ(all.bounded(), 2.25);
  EXPECT_EQ(all.count(), 4096u);
  EXPECT_EQ(all.choice(), 8u);
  EXPECT_EQ(all.big(), 7u);
  EXPECT_TRUE(all.flag());
  EXPECT_EQ(all.number(), 0.0);
  EXPECT_FALSE(all.has_part());
  EXPECT_FALSE(all.has_inner());
}

TEST(YamlValues, OutOfRangeNameTheRangeAndItsUnit) {
  EXPECT_EQ(refusal("text: a\nbounded: 6\n"),
            "t.yaml:2:10: bounded: 6 is out of range; allowed: -5 to 5.5 m");
  EXPECT_EQ(refusal("bounded:   -5.000001"),
            "t.yaml:1:12: bounded: -5.000001 is out of range; allowed: -5 to 5.5 m");
  EXPECT_EQ(refusal("at_least: 1.9"),
            "t.yaml:1:11: at_least: 1.9 is out of range; allowed: at least 2 kn");
  EXPECT_EQ(refusal("at_most: 10"), "t.yaml:1:10: at_most: 10 is out of range; allowed: at most 9");
  EXPECT_EQ(refusal("count: 255"),
            "t.yaml:1:8: count: 255 is out of range; allowed: 256 to 8192 per turn");
  EXPECT_EQ(refusal("numbers: [1, 2, 11]"),
            "t.yaml:1:17: numbers[2]: 11 is out of range; allowed: at most 10");
  EXPECT_EQ(refusal("parts:\n  - name: a\n  - name: b\n    width_m: 81"),
            "t.yaml:4:14: parts[1].width_m: 81 is out of range; allowed: 0.5 to 80 m");
  for (const char* edge : {"bounded: -5", "bounded: 5.5", "count: 256", "count: 8192"}) {
    EXPECT_EQ(refusal(edge), "");
  }
}

TEST(YamlValues, NotInAListOfChoicesNameTheChoices) {
  EXPECT_EQ(refusal("choice: 6"),
            "t.yaml:1:9: choice: 6 is not one of these; allowed: 4, 8 per cell");
  EXPECT_EQ(refusal("scale: 0.25"),
            "t.yaml:1:8: scale: 0.25 is not one of these; allowed: 0.125, 0.75, 6 NM");
}

TEST(YamlValues, OfWholeNumbersAreNeitherNegativeNorBrokenNorTooLarge) {
  EXPECT_EQ(refusal("whole: -1"),
            "t.yaml:1:8: whole: -1 is out of range; allowed: 0 to 4294967295");
  EXPECT_EQ(refusal("count: -300"),
            "t.yaml:1:8: count: -300 is out of range; allowed: 256 to 8192 per turn");
  EXPECT_EQ(refusal("whole: 4294967296"),
            "t.yaml:1:8: whole: 4294967296 is out of range; allowed: 0 to 4294967295");
  EXPECT_EQ(refusal("big: 18446744073709551616"),
            "t.yaml:1:6: big: 18446744073709551616 is out of range; allowed: 0 to "
            "18446744073709551615");
  EXPECT_EQ(refusal("whole: 1.5"),
            "t.yaml:1:8: whole: 1.5 is not a whole number; allowed: 0 to 4294967295");
  EXPECT_EQ(refusal("whole: 1e3"),
            "t.yaml:1:8: whole: 1e3 is not a whole number; allowed: 0 to 4294967295");
  EXPECT_EQ(loaded("whole: -0").whole(), 0u);
  EXPECT_EQ(loaded("whole: +7").whole(), 7u);
}

TEST(YamlValues, AreFiniteNumbers) {
  for (const std::string text : {".nan", "NaN", ".inf", "-.Inf", "infinity", "+inf"}) {
    EXPECT_EQ(refusal("bounded: " + text),
              "t.yaml:1:10: bounded: " + text + " is not a finite number; allowed: -5 to 5.5 m");
    EXPECT_EQ(refusal("number: " + text),
              "t.yaml:1:9: number: " + text + " is not a finite number");
  }
  EXPECT_EQ(refusal("number: 1e999"),
            "t.yaml:1:9: number: 1e999 is too large or too small for a double");
  EXPECT_EQ(loaded("number: 1.7976931348623157e308").number(), std::numeric_limits<double>::max());
}

TEST(YamlValues, OfTheWrongTypeSayWhatWasExpectedAndWhatWasGiven) {
  EXPECT_EQ(refusal("bounded: fast"),
            "t.yaml:1:10: bounded: expected a number, given fast; allowed: -5 to 5.5 m");
  EXPECT_EQ(refusal("number: '5'"), "t.yaml:1:9: number: expected a number, given the text \"5\"");
  EXPECT_EQ(refusal("number: [5]"), "t.yaml:1:9: number: expected a number, given a list");
  EXPECT_EQ(refusal("number: {a: 5}"),
            "t.yaml:1:9: number: expected a number, given keys and values");
  EXPECT_EQ(refusal("text: a\nnumber:\nflag: true"),
            "t.yaml:2:1: number: expected a number, given nothing");
  EXPECT_EQ(refusal("number: ~"), "t.yaml:1:1: number: expected a number, given nothing");
  EXPECT_EQ(refusal("whole: many"),
            "t.yaml:1:8: whole: expected a whole number, given many; allowed: 0 to 4294967295");
  EXPECT_EQ(refusal("big: [1]"),
            "t.yaml:1:6: big: expected a whole number, given a list; allowed: 0 to "
            "18446744073709551615");
  EXPECT_EQ(refusal("flag: yes"), "t.yaml:1:7: flag: expected true or false, given yes");
  EXPECT_EQ(refusal("flag: 'true'"),
            "t.yaml:1:7: flag: expected true or false, given the text \"true\"");
  EXPECT_EQ(refusal("flag: 1"), "t.yaml:1:7: flag: expected true or false, given 1");
  EXPECT_EQ(refusal("text: [a]"), "t.yaml:1:7: text: expected text, given a list");
  EXPECT_EQ(refusal("text:"), "t.yaml:1:1: text: expected text, given nothing");
  EXPECT_EQ(refusal("part: 5"), "t.yaml:1:7: part: expected keys and values, given 5");
  EXPECT_EQ(refusal("parts: {name: a}"),
            "t.yaml:1:8: parts: expected a list, given keys and values");
  EXPECT_EQ(refusal("parts: [a]"), "t.yaml:1:9: parts[0]: expected keys and values, given a");
  EXPECT_EQ(refusal("numbers: 5"), "t.yaml:1:10: numbers: expected a list, given 5");
  EXPECT_EQ(refusal("- a"), "t.yaml:1:1: expected keys and values, given a list");
  EXPECT_EQ(refusal(""), "t.yaml:1:1: expected keys and values, given nothing");
}

TEST(YamlValues, ThatOnlyLookLikeNumbersAreNone) {
  for (const std::string text :
       {"1_000", "5 m", "1,5", "--1", "+-1", "1e", "12:30", "1.2.3", "\xD9\xA1", ".", "e5"}) {
    EXPECT_EQ(refusal("words: [a]\nnumber: " + text + "\n"),
              "t.yaml:2:9: number: expected a number, given " + text);
  }
}

TEST(YamlValues, OfTextAreOneLineOfBoundedLength) {
  EXPECT_EQ(refusal("text: \"a\\nb\""),
            "t.yaml:1:7: text: \"a\\x0ab\" holds a control character; allowed: one line of text");
  EXPECT_EQ(refusal("text: \"\\e[2J\""),
            "t.yaml:1:7: text: \"\\x1b[2J\" holds a control character; allowed: one line of text");
  EXPECT_EQ(refusal("text: " + std::string(4096, 'a')), "");
  EXPECT_EQ(refusal("text: " + std::string(4097, 'a')),
            "t.yaml:1:7: text: 4097 bytes of text; allowed: at most 4096");
  EXPECT_EQ(loaded("text: ''").text(), "");
  EXPECT_EQ(loaded("text: 12").text(), "12");
  EXPECT_EQ(loaded("text: true").text(), "true");
  EXPECT_EQ(refusal("part: {name: ''}"),
            "t.yaml:1:14: part.name: is empty; allowed: at least one character");
}

TEST(YamlValues, OfSignedNumbersFloatsAndEnumsAreRead) {
  const test::EveryKind all = loaded(
      "signed_whole: -2147483648\nsigned_big: -9223372036854775808\nsingle: -3e38\npace: fast");
  EXPECT_EQ(all.signed_whole(), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(all.signed_big(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(all.single(), -3e38f);
  EXPECT_EQ(all.pace(), test::FAST);
  EXPECT_EQ(loaded("text: a").signed_whole(), -3);
  EXPECT_EQ(loaded("text: a").single(), 0.5f);
  EXPECT_EQ(refusal("signed_whole: 2147483648"),
            "t.yaml:1:15: signed_whole: 2147483648 is out of range; allowed: -2147483648 to "
            "2147483647");
  EXPECT_EQ(refusal("signed_big: -9223372036854775809"),
            "t.yaml:1:13: signed_big: -9223372036854775809 is out of range; allowed: "
            "-9223372036854775808 to 9223372036854775807");
  EXPECT_EQ(refusal("single: 4e38"), "t.yaml:1:9: single: 4e38 is out of range");
  EXPECT_EQ(refusal("pace: quick"), "t.yaml:1:7: pace: expected one of slow, fast, given quick");
  EXPECT_EQ(refusal("pace: 1"), "t.yaml:1:7: pace: expected one of slow, fast, given 1");
}

TEST(YamlValues, OfWholeNumbersMayBeHexadecimal) {
  EXPECT_EQ(loaded("big: 0xDEADbeef").big(), 0xDEADBEEFu);
  EXPECT_EQ(loaded("big: 0xffffffffffffffff").big(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(refusal("whole: 0x100000000"),
            "t.yaml:1:8: whole: 0x100000000 is out of range; allowed: 0 to 4294967295");
  for (const std::string text : {"0x", "0xg", "0x-1", "-0x1", "0x1.8"}) {
    EXPECT_EQ(refusal("whole: " + text), "t.yaml:1:8: whole: expected a whole number, given " +
                                             text + "; allowed: 0 to 4294967295");
  }
  EXPECT_EQ(refusal("number: 0x1"), "t.yaml:1:9: number: expected a number, given 0x1");
}

TEST(YamlValues, OfTextAreBoundedInCharacters) {
  EXPECT_EQ(loaded("short_text: \xC3\xA6\xC3\xB8\xC3\xA5").short_text(),
            "\xC3\xA6\xC3\xB8\xC3\xA5");
  EXPECT_EQ(refusal("short_text: \xC3\xA6\xC3\xB8\xC3\xA5!"),
            "t.yaml:1:13: short_text: \"\xC3\xA6\xC3\xB8\xC3\xA5!\" has 4 characters; allowed: at "
            "most 3 characters");
}

TEST(YamlValues, OfAnAbsentSectionAreItsDefaultsUnlessItIsOptional) {
  const test::EveryKind all = loaded("text: a");
  EXPECT_EQ(all.section().port(), 7410u);
  EXPECT_EQ(all.section().inner().pace(), test::FAST);
  EXPECT_FALSE(all.has_own_section());
  EXPECT_FALSE(all.has_part()) << "it has a required key";
  EXPECT_FALSE(all.has_inner()) << "it holds itself";
  const test::EveryKind given = loaded("section: {inner: {pace: slow}}\nown_section: {}");
  EXPECT_EQ(given.section().port(), 7410u);
  EXPECT_EQ(given.section().inner().pace(), test::SLOW);
  EXPECT_EQ(given.own_section().port(), 7410u);
}

TEST(YamlValues, OfATypeThatTheReaderDoesNotKnowAreAFaultOfTheSchema) {
  test::UnreadableBytes bytes;
  EXPECT_THROW(load_yaml("raw: a", "t.yaml", bytes), std::logic_error);
  test::UnreadableMap map;
  EXPECT_THROW(load_yaml("by_name: {a: 1}", "t.yaml", map), std::logic_error);
  EXPECT_THROW(load_yaml("by_name: [{key: a, value: 1}]", "t.yaml", map), std::logic_error);
}

}  // namespace
}  // namespace skerry::server
