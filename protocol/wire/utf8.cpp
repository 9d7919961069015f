#include "protocol/wire/utf8.hpp"

#include <algorithm>
#include <array>

namespace skerry {

std::optional<char32_t> take_code_point(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  std::size_t more = 0;
  char32_t value = first;
  if (first >= 0x80) {
    more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    if (first < 0xc2 || first > 0xf4 || text.size() <= more) return std::nullopt;
    value = first & (0x3fu >> more);
    for (std::size_t i = 1; i <= more; ++i) {
      const auto next = static_cast<unsigned char>(text[i]);
      if ((next & 0xc0u) != 0x80u) return std::nullopt;
      value = (value << 6) | (next & 0x3fu);
    }
  }
  constexpr std::array<char32_t, 4> kShortest = {0, 0x80, 0x800, 0x10000};
  if (value < kShortest[more] || value > 0x10ffff) return std::nullopt;
  if (value >= 0xd800 && value < 0xe000) return std::nullopt;
  text.remove_prefix(more + 1);
  return value;
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace skerry
