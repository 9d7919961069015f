// Text from outside, made fit for a terminal, a picture or a PNG chunk.
#pragma once

#include <string>
#include <string_view>

namespace skerry {

// At most `longest` characters of `text`; whatever is not printable ASCII becomes '?', so that a
// server cannot send escape sequences to somebody's terminal.
inline std::string printable(std::string_view text, std::size_t longest = 512) {
  std::string out(text.substr(0, longest));
  for (char& c : out) {
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  return out;
}

}  // namespace skerry
