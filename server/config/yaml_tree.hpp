// YamlNode: a YAML text as a tree whose every node knows its place.
#pragma once

#include <string>
#include <vector>

#include "server/config/config_error.hpp"

namespace skerry::server {

struct YamlNode {
  enum class Kind { null, plain, quoted, list, map, alias };

  Kind kind = Kind::null;
  TextPlace place;
  std::string text;             // of plain and quoted
  std::vector<YamlNode> keys;   // of a map, in order, as written
  std::vector<YamlNode> items;  // of a list; of a map, the values of its keys
};

// What a text may hold.  Far above any sensible scenario (1000 targets of 1000 waypoints do not
// fit, 1000 of 20 do: YamlText.AThousandTargetsOfTwentyWaypointsFit) and small enough that the
// worst text found, a mebibyte of opening brackets, costs 250 MB for half a second; the thousand
// targets cost 20 MB.
inline constexpr std::size_t kMaxYamlBytes = 1 << 20;
inline constexpr std::size_t kMaxYamlNodes = 150'000;  // values and keys
inline constexpr std::size_t kMaxYamlDepth = 32;       // lists and maps within each other

// The one document of the text; an empty text is a null node.  Reads the part of YAML that a
// configuration needs: no anchors and aliases, which can make a small text a huge one; no tags; no
// second document.  A map may hold a key twice here.  Anchors and tags are complained of in
// `source` and the rest is read; an alias becomes a node of that kind.
// Error: ConfigError with the first place from which the text cannot be read further, and what was
// complained of before it: no YAML, not UTF-8, a control character, a limit passed, a second
// document.
// `file`: whose text it is, as TextPlace has it.
YamlNode parse_yaml(const std::string& text, YamlSource& source, int file = 0);

}  // namespace skerry::server
