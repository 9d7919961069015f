// The include law: which folder may include which, and a few rules of the same kind.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::architecture {

// One breach: where, which rule, what to do.
struct Breach {
  std::string file;
  std::size_t line = 1;
  std::string text;
};

// "file:line: text", one a line.
std::string listed(const std::vector<Breach>& breaches);

// Breaches in a file that stands at `path` (from the repository's root) and says `text`.
std::vector<Breach> breaches_of(std::string_view path, std::string_view text);

// Every file that breaches_of() has a rule for, from the root, sorted; nothing that was installed
// or built.
std::vector<std::string> source_files(const std::filesystem::path& root);

// The folders the table has a row for.
std::vector<std::string> rooms();

}  // namespace skerry::architecture
