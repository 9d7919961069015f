#include "server/access/file_text.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "server/config/config_error.hpp"

namespace skerry::server {

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

void require_entry(std::string_view what, std::string_view name, std::string_view ship) {
  constexpr std::size_t kMost = 64;
  if (name.empty() || name.size() > kMost) {
    throw std::invalid_argument(fmt::format("a {}'s name has 1 to {} bytes", what, kMost));
  }
  if (printable(name, kMost) != name || printable(ship, kMost) != ship) {
    throw std::invalid_argument(
        fmt::format("a {}'s name and ship have printable letters alone", what));
  }
  if (ship.size() > kMost) {
    throw std::invalid_argument(fmt::format("a ship's name has at most {} bytes", kMost));
  }
}

}  // namespace skerry::server
