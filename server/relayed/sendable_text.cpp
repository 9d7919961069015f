#include "server/relayed/sendable_text.hpp"

#include "protocol/wire/utf8.hpp"

namespace skerry::server {

std::string sendable(std::string_view text, std::size_t most) {
  std::string out;
  while (!text.empty()) {
    std::string_view rest = text;
    const bool is_character = take_code_point(rest).has_value();
    if (!is_character) rest.remove_prefix(1);
    const std::string_view next = text.substr(0, text.size() - rest.size());
    if (out.size() + next.size() > most) break;
    out += is_character ? next : "?";
    text = rest;
  }
  return out;
}

}  // namespace skerry::server
