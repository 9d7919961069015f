// Text of a file or a path as messages can carry it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace skerry::server {

// Whole characters of UTF-8, at most `most` bytes of them; '?' in place of every byte that is none.
std::string sendable(std::string_view text, std::size_t most);

}  // namespace skerry::server
