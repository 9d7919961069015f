// Finds the key that a mistyped one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skerry::server {

// Letters to insert, delete, replace or swap with their neighbour to turn `a` into `b` (optimal
// string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

// The first of the `known` keys nearest to `key`, if no more than a third of its letters (one, of a
// key of less than six) have to change; otherwise empty.
std::string nearest_key(std::string_view key, const std::vector<std::string>& known);

}  // namespace skerry::server
