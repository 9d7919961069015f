// A YAML file and those that it includes, as one tree.
#pragma once

#include <string>

#include "server/config/yaml_tree.hpp"

namespace skerry::server {

inline constexpr int kMaxIncludedFiles = 64;
inline constexpr int kMaxIncludeDepth = 8;

// The tree of `text`, which is the file source.file_name(), and of the files that its key `include`
// at the top lists, by paths from the folder of the file that has it.  They may include others.
// Lists are appended: those of included files first, in order, then the file's own; maps are joined
// key by key; of single values the including file's is taken.  The key is not in the tree.
// What is wrong with `include` is refused in `source`, and the rest is read.  All files together
// are as long as one may be. Error: ConfigError as parse_yaml(), also of an included file.
YamlNode parse_yaml_whole(const std::string& text, YamlSource& source);

// A text that parse_yaml() makes that tree of, but for places.
std::string yaml_text(const YamlNode& root);

}  // namespace skerry::server
