// No two headers of a namespace define types of one name: a program that links both would take the
// one's code for the other's, and no compiler says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "tests/architecture/include_law.hpp"

namespace skerry::architecture {
namespace {

using testing::ElementsAre;

// Types that are defined at the outermost level of a header, each "skerry::server::Approach".
std::vector<std::string> types_of(const std::string& text) {
  static const std::regex space("^namespace (skerry[a-z0-9_:]*) \\{");
  static const std::regex type(
      "^(?:struct|class|enum class) ([A-Za-z0-9_]+)(?: final)? ?(?::[^:].*|\\{.*)$");
  std::vector<std::string> types;
  std::string name;
  std::smatch match;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (std::regex_search(line, match, space)) name = match[1];
    if (std::regex_match(line, match, type)) types.push_back(name + "::" + match[1].str());
  }
  return types;
}

TEST(TypeNames, AreGivenOnceInANamespace) {
  const std::filesystem::path root = SKERRY_SOURCE_DIR;
  std::map<std::string, std::string> headers;  // by type
  for (const std::string& file : source_files(root)) {
    if (!file.ends_with(".hpp") || file.starts_with("tests/")) continue;
    std::ifstream in(root / file, std::ios::binary);
    for (const std::string& type : types_of({std::istreambuf_iterator<char>(in), {}})) {
      const auto [other, is_new] = headers.emplace(type, file);
      EXPECT_TRUE(is_new) << type << " is defined in " << other->second << " and in " << file
                          << "; give one of them another name";
    }
  }
  EXPECT_GT(headers.size(), 300u);
}

TEST(TypeNames, TheTestFindsThem) {
  EXPECT_THAT(
      types_of("#pragma once\n"
               "namespace skerry::server {\n"
               "class Later;\n"
               "struct Approach {\n  struct Inner {};\n};\n"
               "enum class Mode : int { a };\n"
               "class Host final : public Port {\n};\n"
               "}\n"),
      ElementsAre("skerry::server::Approach", "skerry::server::Mode", "skerry::server::Host"));
}

}  // namespace
}  // namespace skerry::architecture
