// ConfigError: what is wrong with a configuration file, and where.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace skerry::server {

// A place in a text: both count from 1, columns in characters.
struct TextPlace {
  int line = 1;
  int column = 1;
};

// what() is "FILE:LINE:COLUMN: KEY PATH: what was wrong, what is allowed", e.g.
//   bergen.yaml:12:10: own_ships[0].radars[1].rpm: 75 is out of range; allowed: 12 to 60 turns/min
// in printable text of one line; the key path is left out where there is none.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ConfigError(const std::string& file, TextPlace place, const std::string& path,
              const std::string& text);
};

// `text` as it may stand in a message: control characters and what is not UTF-8 as \xNN, and cut
// after `longest` bytes, at a character's border, with "..." in place of the rest.
std::string printable(std::string_view text, std::size_t longest = 60);

// The number of bytes of the UTF-8 character that begins at `at`; 0 if none does (RFC 3629: no
// overlong form, no surrogate, nothing above U+10FFFF).  Requires at < text.size().
std::size_t utf8_length(std::string_view text, std::size_t at);

// Characters of UTF-8 text.
std::size_t character_count(std::string_view text);

}  // namespace skerry::server
