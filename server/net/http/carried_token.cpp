#include "server/net/http/carried_token.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::server {
namespace {

constexpr std::string_view kTokenSubprotocol = "skerry.token.", kAroundParts = " \t";

std::string_view without_blanks(std::string_view text) {
  const auto begin = text.find_first_not_of(kAroundParts);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kAroundParts) - begin + 1);
}

// Calls take(part) for each part between separators.
template <typename Take>
void for_each_part(std::string_view text, char separator, const Take& take) {
  while (!text.empty()) {
    const auto end = std::min(text.find(separator), text.size());
    take(without_blanks(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string cookie_of(std::string_view value, std::string_view more) {
  return fmt::format("{}={}; Path=/; Secure; HttpOnly; SameSite=Strict{}", kTokenCookie, value,
                     more);
}

}  // namespace

std::string_view cookie_token(std::string_view header) {
  std::string_view token;
  int found = 0;
  for_each_part(header, ';', [&](std::string_view pair) {
    const auto equals = pair.find('=');
    if (equals == std::string_view::npos || pair.substr(0, equals) != kTokenCookie) return;
    ++found;
    token = pair.substr(equals + 1);
  });
  return found == 1 ? token : std::string_view();
}

std::string cookie_with(std::string_view token) { return cookie_of(token, ""); }
std::string cookie_without_token() { return cookie_of("", "; Max-Age=0"); }

OfferedSubprotocols offered_subprotocols(std::string_view header) {
  OfferedSubprotocols offered;
  for_each_part(header, ',', [&](std::string_view name) {
    if (name == kSubprotocol) offered.skerry = true;
    if (!offered.token.empty() || !name.starts_with(kTokenSubprotocol)) return;
    offered.token = name.substr(kTokenSubprotocol.size());
  });
  return offered;
}

}  // namespace skerry::server
