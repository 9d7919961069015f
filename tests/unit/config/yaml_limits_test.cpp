// Texts that are no YAML, or more of it than a configuration needs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "server/config/yaml_tree.hpp"
#include "server/world/scenario.pb.h"
#include "tests/unit/config/loading.hpp"

namespace skerry::server {
namespace {

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

TEST(YamlText, ThatIsNoYamlSaysWhereAndIsNotCheckedFurther) {
  const std::string end = "; nothing else was checked";
  EXPECT_EQ(refusal("number: x\ntext: \"a"), "t.yaml:2:9: not YAML: illegal EOF in scalar" + end);
  EXPECT_EQ(refusal("parts: [a, b"),
            "t.yaml:1:1: not YAML: end of sequence flow not found; it begins at 1:8" + end);
  EXPECT_EQ(refusal("part:\n  name: a\n number: 1"),
            "t.yaml:3:2: not YAML: end of map not found; it begins at 1:1" + end);
  EXPECT_EQ(refusal("number: 1\n\ttext: a").substr(0, 21), "t.yaml:2:1: not YAML:");
  EXPECT_EQ(refusal("number: 1\n text: a").substr(0, 21), "t.yaml:2:6: not YAML:");
  EXPECT_EQ(refusal("text: \"a\nnumber: 1\n\n"),
            "t.yaml:2:10: not YAML: illegal EOF in scalar" + end);
  EXPECT_EQ(refusal("text: 'a\n"), "t.yaml:1:9: not YAML: illegal EOF in scalar" + end);
  EXPECT_EQ(refusal("text: @a"), "t.yaml:1:7: not YAML: unknown token" + end);
  EXPECT_EQ(refusal("text: &a b\nnumber: @a"),
            "t.yaml:1:7: anchor &a: anchors and aliases are not supported; write the value out\n"
            "t.yaml:2:9: not YAML: unknown token" +
                end + "\nt.yaml: 2 errors");
}

TEST(YamlText, HoldsOneDocument) {
  EXPECT_EQ(refusal("---\nnumber: 1\n...\n"), "");
  EXPECT_EQ(refusal("number: 1\n---\nnumber: 2\n"),
            "t.yaml:2:1: the document has ended before this; allowed: one document a file, and "
            "entries of one indentation");
}

TEST(YamlText, HasNoAnchorsAliasesAndTags) {
  // Ten lists of ten each: a thousand million entries, were aliases followed.
  std::string laughs = "a: &a [x,x,x,x,x,x,x,x,x,x]\n";
  for (char name = 'b'; name <= 'i'; ++name) {
    const std::string nine = repeated(fmt::format("*{:c},", name - 1), 9);
    laughs += fmt::format("{}: &{} [{}*{:c}]\n", name, name, nine, name - 1);
  }
  EXPECT_NE(refusal(laughs).find("\nt.yaml:9:4: anchor &i: anchors and aliases are not supported; "
                                 "write the value out\nt.yaml: 18 errors"),
            std::string::npos)
      << "nine of them, and nine unknown keys";
  const std::string anchor = "anchors and aliases are not supported; write the value out\n";
  const std::string alias = "given an alias (aliases are not supported; write the value out)\n";
  EXPECT_EQ(refusal("text: &a b\nnumber: *a\n*a : 1"),
            "t.yaml:1:7: anchor &a: " + anchor + "t.yaml:2:9: number: expected a number, " + alias +
                "t.yaml:3:1: expected a key, " + alias + "t.yaml: 3 errors");
  EXPECT_EQ(refusal("text: *a").substr(0, 12), "t.yaml:1:7: ");
  EXPECT_EQ(refusal("inner: &a {inner: *a}").substr(0, 25), "t.yaml:1:8: anchor &a: an");
  EXPECT_EQ(refusal("text: !!binary aGk="),
            "t.yaml:1:7: tag tag:yaml.org,2002:binary: tags are not supported");
  EXPECT_EQ(refusal("part: !mine {name: a}"), "t.yaml:1:7: tag !mine: tags are not supported");
}

TEST(YamlText, IsNotTooDeep) {
  const auto nested = [](std::size_t depth) {
    return repeated("{inner: ", depth - 1) + "{}" + repeated("}", depth - 1);
  };
  EXPECT_EQ(refusal(nested(kMaxYamlDepth)), "");
  const std::string expected = "too deep: more than 32 lists and maps within each other";
  EXPECT_EQ(refusal(nested(kMaxYamlDepth + 1)), "t.yaml:1:257: " + expected);
  for (const char* bracket : {"[", "{", "- ", "? ", "{a: ", "[["}) {
    EXPECT_NE(refusal(repeated(bracket, 100'000) + "1").find(expected), std::string::npos)
        << bracket;
  }
}

TEST(YamlText, IsNotTooLong) {
  const std::string comment = "number: 5 #";
  EXPECT_EQ(refusal(comment + std::string(kMaxYamlBytes - comment.size(), 'a')), "");
  EXPECT_EQ(refusal(comment + std::string(kMaxYamlBytes - comment.size() + 1, 'a')),
            "t.yaml:1:1: too long: 1048577 bytes; allowed: at most 1048576");
}

TEST(YamlText, HoldsNotTooManyValues) {
  // A map, a key and a list: three nodes without the entries.
  const auto entries = [](std::size_t count) { return "numbers:\n" + repeated("- 1\n", count); };
  EXPECT_EQ(loaded(entries(kMaxYamlNodes - 3)).numbers_size(), 149'997);
  EXPECT_EQ(refusal(entries(kMaxYamlNodes - 2)),
            "t.yaml:149999:3: too much: more than 150000 keys and values");
}

TEST(YamlText, AThousandTargetsOfTwentyWaypointsFit) {
  std::string text = "name: Test\nown_ships: [{name: a, position: {lat: 0, lon: 0}}]\ntargets:\n";
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format(
        "  - name: Target {}\n    position: {{lat: 60.425, lon: 5.040}}\n    speed_kn: 12.5\n"
        "    length_m: 92\n    beam_m: 15\n    height_m: 18\n    waypoints:\n{}",
        i, repeated("      - {lat: 60.456, lon: 5.050}\n", 20));
  }
  EXPECT_EQ(loaded<scenario::Scenario>(text).targets(999).waypoints_size(), 20);
}

TEST(YamlText, IsUtf8WithoutControlCharacters) {
  EXPECT_EQ(refusal("text: a\ntext: S\xF8r"),
            "t.yaml:2:8: byte 0xf8 is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(refusal("text: \xED\xA0\x80"),
            "t.yaml:1:7: byte 0xed is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(refusal("text: a\x01"), "t.yaml:1:8: control character 0x01; allowed: text");
  EXPECT_EQ(refusal(std::string("text: a\0b", 9)),
            "t.yaml:1:8: control character 0x00; allowed: text");
  EXPECT_EQ(refusal("\xFF\xFEn\xC3\xB8").substr(0, 28), "t.yaml:1:1: byte 0xff is not");
}

}  // namespace
}  // namespace skerry::server
