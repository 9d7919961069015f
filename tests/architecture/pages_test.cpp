// Reads every page (*.md) and every comment: what they point to exists in the repository.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/include_law.hpp"

namespace skerry::architecture {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::IsEmpty;
using testing::SizeIs;

const fs::path kPagesRoot = SKERRY_SOURCE_DIR;
constexpr std::string_view kPathLetters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";

std::string text_of_page(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Every page, from the root, sorted; nothing that was installed or built.
std::set<std::string> pages() {
  std::set<std::string> found;
  for (auto it = fs::recursive_directory_iterator(kPagesRoot); it != fs::end(it); ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory() && (name == "build" || name == "node_modules" || name.starts_with('.')))
      it.disable_recursion_pending();
    else if (name.ends_with(".md"))
      found.insert(fs::relative(it->path(), kPagesRoot).generic_string());
  }
  return found;
}

// "## 9. Not modelled" -> "9-not-modelled", as hosts of repositories make anchors.
std::string anchor_of(std::string_view heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(letter));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

// Headings of a page: without their marks, and code blocks passed over.
std::vector<std::string> headings_of(const std::string& text) {
  std::vector<std::string> headings;
  bool code = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.starts_with("```")) code = !code;
    const std::size_t marks = line.find_first_not_of('#');
    if (!code && marks != 0 && marks != std::string::npos && line[marks] == ' ')
      headings.push_back(line.substr(marks + 1));
  }
  return headings;
}

// Links of a page that lead nowhere.
std::vector<std::string> dead_links(const fs::path& page, const std::string& text) {
  std::vector<std::string> dead;
  for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
    const std::string link = text.substr(at + 2, text.find(')', at) - at - 2);
    if (link.starts_with("http") || link.find_first_of(" \n") != std::string::npos) continue;
    const std::string path = link.substr(0, link.find('#'));
    const fs::path target = path.empty() ? page : page.parent_path() / path;
    bool lives = fs::exists(target);
    if (lives && link.find('#') != std::string::npos) {
      const auto headings = headings_of(text_of_page(target));
      lives = std::any_of(headings.begin(), headings.end(), [&](const std::string& heading) {
        return anchor_of(heading) == link.substr(link.find('#') + 1);
      });
    }
    if (!lives) dead.push_back(link);
  }
  return dead;
}

// Whether a file or folder has that name, as it stands or with the ending of a source.
bool stands(const fs::path& name) {
  return fs::exists(name) || fs::exists(name.string() + ".hpp") ||
         fs::exists(name.string() + ".cpp") || fs::exists(name.string() + ".js");
}

// `echo/chart/local_plane`, `server/run`: names in a page that begin with a folder of the top.
std::vector<std::string> missing_names(const std::string& text) {
  std::vector<std::string> missing;
  for (const std::string_view top : {"protocol/", "echo/", "server/", "clients/", "tests/"}) {
    const std::string opening = "`" + std::string(top);
    for (std::size_t at = text.find(opening); at != std::string::npos;
         at = text.find(opening, at + 1)) {
      const std::string name = text.substr(at + 1, text.find('`', at + 1) - at - 1);
      if (name.find_first_not_of(kPathLetters) != std::string::npos) continue;
      if (!stands(kPagesRoot / name)) missing.push_back(name);
    }
  }
  return missing;
}

// Names of pages ("unknown.md", "nmea/README.md") in `text` that no page has.
std::vector<std::string> unknown_pages(const std::string& text,
                                       const std::set<std::string>& known) {
  std::vector<std::string> unknown;
  for (std::size_t at = text.find(".md"); at != std::string::npos; at = text.find(".md", at + 1)) {
    const std::size_t end = at + 3;
    if (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0)) continue;
    std::size_t begin = at;
    while (begin > 0 && kPathLetters.find(text[begin - 1]) != std::string_view::npos) --begin;
    std::string name = text.substr(begin, end - begin);
    while (name.starts_with("../")) name.erase(0, 3);
    if (name.starts_with('/')) name.erase(0, 1);
    if (name == ".md") continue;  // "*.md"
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& page) {
      return page == name || page.ends_with("/" + name);
    });
    if (!is_known) unknown.push_back(name);
  }
  return unknown;
}

// Sections that comments name, as in: SOURCES.md "Pictures (e)".
std::vector<std::string> unknown_sections(const std::string& text,
                                          const std::vector<std::string>& sections) {
  const std::string mark = "SOURCES.md \"";
  std::vector<std::string> unknown;
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    const std::string section = text.substr(begin, text.find_first_of(" \"\n", begin) - begin);
    if (std::find(sections.begin(), sections.end(), section) == sections.end())
      unknown.push_back(section);
  }
  return unknown;
}

TEST(Pages, LinkOnlyToWhatExists) {
  for (const std::string& page : pages())
    EXPECT_THAT(dead_links(kPagesRoot / page, text_of_page(kPagesRoot / page)), IsEmpty()) << page;
}

TEST(Pages, NameOnlyFilesThatExist) {
  for (const std::string& page : pages())
    EXPECT_THAT(missing_names(text_of_page(kPagesRoot / page)), IsEmpty()) << page;
}

TEST(Pages, AndCommentsNameNoPageOutsideTheRepository) {
  const auto known = pages();
  const auto sections = headings_of(text_of_page(kPagesRoot / "echo/SOURCES.md"));
  auto files = source_files(kPagesRoot);
  files.insert(files.end(), known.begin(), known.end());
  for (const std::string& file : files) {
    if (file == "tests/architecture/pages_test.cpp") continue;
    const std::string text = text_of_page(kPagesRoot / file);
    EXPECT_THAT(unknown_pages(text, known), IsEmpty()) << file;
    EXPECT_THAT(unknown_sections(text, sections), IsEmpty()) << file;
  }
}

// Each check finds what is wrong, so that an empty answer above means something.
TEST(Pages, TheChecksFindWhatIsWrong) {
  const auto known = pages();
  EXPECT_THAT(known, Contains("README.md"));
  EXPECT_THAT(known, Contains("echo/SOURCES.md"));
  EXPECT_THAT(
      dead_links(kPagesRoot / "README.md",
                 "[a](echo/MODEL.md#no-such) [b](no.md) [c](echo/MODEL.md#1-the-way-of-a-spoke)"),
      SizeIs(2));
  EXPECT_THAT(missing_names("`echo/no_such_thing`, `server/run`, `echo/MODEL.md`"), SizeIs(1));
  EXPECT_THAT(unknown_pages("unknown.md, SOURCES.md, *.md, .mdx", known), SizeIs(1));
  EXPECT_THAT(unknown_sections("SOURCES.md \"Sea\", SOURCES.md \"Moon\"", {"Sea"}), SizeIs(1));
}

}  // namespace
}  // namespace skerry::architecture
