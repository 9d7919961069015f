// UTF-8 of text from outside.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace skerry {

// The first code point of UTF-8 (RFC 3629: no overlong form, no surrogate, nothing above U+10FFFF),
// which is taken off; nothing if none begins there, and `text` stays as it is.  `text` is not
// empty.
std::optional<char32_t> take_code_point(std::string_view& text);

// Characters of text that is UTF-8.
std::size_t character_count(std::string_view text);

// U+0000 to U+001F and U+007F to U+009F.
constexpr bool is_control_character(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

}  // namespace skerry
