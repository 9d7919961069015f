// UTF-8 of text from outside.
#pragma once

#include <optional>
#include <string_view>

namespace skerry::server {

// The first code point of UTF-8 (RFC 3629), which is taken off; nothing if none begins there, and
// `text` stays as it is.  `text` is not empty.
std::optional<char32_t> take_code_point(std::string_view& text);

}  // namespace skerry::server
