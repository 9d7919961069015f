// Keys: unknown, given twice, missing; the order of errors; the message after an error; files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/config/loading.hpp"

namespace skerry::server {
namespace {

constexpr const char* kKnownKeys =
    "known keys: bounded, at_least, at_most, number, count, choice, whole, big, flag, text, "
    "numbers, words, parts, part, inner, scale, signed_whole, "
    "signed_big, single, pace, short_text, section, own_section";

TEST(YamlKeys, ThatAreUnknownAreErrorsWithASuggestion) {
  EXPECT_EQ(
      refusal("text: a\n  \nboundde: 1"),
      std::string("t.yaml:3:1: boundde: unknown key; did you mean \"bounded\"?; ") + kKnownKeys);
  EXPECT_EQ(refusal("rainbow: 1"), std::string("t.yaml:1:1: rainbow: unknown key; ") + kKnownKeys);
  EXPECT_EQ(refusal("Text: a"),
            std::string("t.yaml:1:1: Text: unknown key; did you mean \"text\"?; ") + kKnownKeys);
  EXPECT_EQ(refusal("parts:\n- name: a\n- name: b\n  widht_m: 3"),
            "t.yaml:4:3: parts[1].widht_m: unknown key; did you mean \"width_m\"?; known keys: "
            "name, width_m");
  EXPECT_EQ(refusal("part: {\"a\\nb\": 3, name: n}"),
            "t.yaml:1:8: part.a\\x0ab: unknown key; known keys: name, width_m");
}

TEST(YamlKeys, ThatAreNoTextAreErrors) {
  EXPECT_EQ(refusal("? [a, b]\n: 1"), "t.yaml:1:3: expected a key, given a list");
  EXPECT_EQ(refusal("? {a: b}\n: 1"), "t.yaml:1:3: expected a key, given keys and values");
  EXPECT_EQ(refusal("~: 1"), "t.yaml:1:1: expected a key, given nothing");
}

TEST(YamlKeys, GivenTwiceNameTheFirst) {
  EXPECT_EQ(refusal("number: 1\ntext: a\nnumber: 1\n"),
            "t.yaml:3:1: number: given twice; first in line 1");
  EXPECT_EQ(refusal("parts:\n- name: a\n  'name': a\n"),
            "t.yaml:3:3: parts[0].name: given twice; first in line 2");
}

TEST(YamlKeys, ThatAreRequiredMustBeThere) {
  EXPECT_EQ(refusal<test::Required>("parts: [{name: a}]"),
            "t.yaml:1:1: length_m: missing; expected a number, 2 to 500 m");
  EXPECT_EQ(refusal<test::Required>("length_m: 5"), "t.yaml:1:1: parts: missing; expected a list");
  EXPECT_EQ(refusal<test::Required>("length_m: 5\nparts: []"),
            "t.yaml:2:8: parts: is empty; expected at least one entry");
  EXPECT_EQ(refusal<test::Required>("length_m: 5\nparts:\n  - width_m: 1"),
            "t.yaml:3:5: parts[0].name: missing; expected text");
  EXPECT_EQ(refusal<test::Required>("length_m: 5\nparts:\n  - {}"),
            "t.yaml:3:5: parts[0].name: missing; expected text");
  EXPECT_EQ(refusal<test::Required>("length_m: 5\nparts: [{name: a}]"), "");
}

TEST(YamlKeys, AreAllCheckedAndListedInTheOrderOfTheText) {
  EXPECT_EQ(refusal("bounded: 9\nrainbow: 1").substr(0, 19), "t.yaml:1:10: bounde");
  EXPECT_EQ(refusal("rainbow: 1\nbounded: 9").substr(0, 18), "t.yaml:1:1: rainbo");
  EXPECT_EQ(refusal<test::Required>("parts: [{name: ''}]"),
            "t.yaml:1:1: length_m: missing; expected a number, 2 to 500 m\n"
            "t.yaml:1:16: parts[0].name: is empty; allowed: at least one character\n"
            "t.yaml: 2 errors");
  EXPECT_EQ(
      refusal("parts:\n"
              "  - name: [a]\n"
              "    name: b\n"
              "  - 7\n"
              "  - {widht_m: 3, name: c}\n"
              "number: !n many\n"
              "words: &p {a: b}\n"
              "numbers: [1, x, 11]\n"
              "part: *p\n"
              "count: 1\n"),
      "t.yaml:2:11: parts[0].name: expected text, given a list\n"
      "t.yaml:3:5: parts[0].name: given twice; first in line 2\n"
      "t.yaml:4:5: parts[1]: expected keys and values, given 7\n"
      "t.yaml:5:6: parts[2].widht_m: unknown key; did you mean \"width_m\"?; known keys: "
      "name, width_m\n"
      "t.yaml:6:9: tag !n: tags are not supported\n"
      "t.yaml:6:9: number: expected a number, given many\n"
      "t.yaml:7:8: anchor &p: anchors and aliases are not supported; write the value out\n"
      "t.yaml:7:8: words: expected a list, given keys and values\n"
      "t.yaml:8:14: numbers[1]: expected a number, given x; allowed: at most 10\n"
      "t.yaml:8:17: numbers[2]: 11 is out of range; allowed: at most 10\n"
      "t.yaml:9:7: part: expected keys and values, given an alias (aliases are not supported; "
      "write the value out)\n"
      "t.yaml:10:8: count: 1 is out of range; allowed: 256 to 8192 per turn\n"
      "t.yaml: 12 errors");
}

TEST(YamlKeys, ColumnsCountCharactersAndLinesAnyLineEnd) {
  EXPECT_EQ(
      refusal("words: [\xC3\xA6\xC3\xB8\xC3\xA5, \xE2\x9A\x93]\r\npart: {name: \xC3\xB8, x: 1}"),
      "t.yaml:2:17: part.x: unknown key; known keys: name, width_m");
  EXPECT_EQ(refusal("\xEF\xBB\xBFnumber: x"), "t.yaml:1:9: number: expected a number, given x");
  EXPECT_EQ(refusal("words: [" + std::string(1000, 'a') + ", \xC3\xA6]\nnumber: x"),
            "t.yaml:2:9: number: expected a number, given x");
  std::string far = "{words: [";
  for (int i = 0; i < 1000; ++i) far += "\xC3\xA6, ";
  EXPECT_EQ(refusal(far + "], number: x}"), "t.yaml:1:3021: number: expected a number, given x");
}

TEST(YamlKeys, LeaveTheMessageAloneAfterAnError) {
  test::EveryKind message = loaded("number: 5\nwords: [a]\npart: {name: b}");
  const std::string before = message.SerializeAsString();
  for (const char* wrong : {"number: 6\ncount: 1", "words: [x, y]\nrainbow: 1", "number: [", "",
                            "part: {name: c, width_m: 0}"}) {
    EXPECT_THROW(load_yaml(wrong, "t.yaml", message), ConfigError) << wrong;
    EXPECT_EQ(message.SerializeAsString(), before) << wrong;
  }
  load_yaml("text: new", "t.yaml", message);
  EXPECT_EQ(message.number(), 0.0) << "the message is replaced, not merged";
  EXPECT_EQ(message.words_size(), 0);
}

TEST(YamlKeys, AreFoundAgainInTheSource) {
  test::EveryKind message;
  const YamlSource source =
      load_yaml("number: 5\nparts:\n  - name: a\n    width_m: 7\n", "t.yaml", message);
  EXPECT_TRUE(source.has("parts[0].width_m"));
  EXPECT_FALSE(source.has("bounded")) << "a default";
  EXPECT_EQ(source.place_of("parts[0].width_m").line, 4);
  EXPECT_EQ(source.place_of("parts[0].width_m").column, 14);
  EXPECT_EQ(source.file_name(), "t.yaml");
}

class YamlFile : public ::testing::Test {
 protected:
  std::string error_of(const std::string& path) {
    test::EveryKind message;
    try {
      load_yaml_file(path, message);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  }
  void write(const std::string& text) {
    std::ofstream(path_, std::ios::binary)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  void TearDown() override { std::filesystem::remove(path_); }

  const std::string path_ = ::testing::TempDir() + "yaml_keys_test.yaml";
};

TEST_F(YamlFile, IsReadAndNamedInErrors) {
  write("number: 5");
  test::EveryKind message;
  load_yaml_file(path_, message);
  EXPECT_EQ(message.number(), 5.0);
  write("number: x");
  EXPECT_EQ(error_of(path_), path_ + ":1:9: number: expected a number, given x");
}

TEST_F(YamlFile, ThatCannotBeReadSaysWhy) {
  EXPECT_EQ(error_of(path_), path_ + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of(::testing::TempDir()),
            ::testing::TempDir() + ": cannot be read: it is a directory");
  EXPECT_EQ(error_of("/dev/zero"),
            "/dev/zero: cannot be read: it is too long; allowed: at most 1048576 bytes");
}

}  // namespace
}  // namespace skerry::server
