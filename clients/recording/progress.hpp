// How often what goes through a recording says how far it is.
#pragma once

#include <cstdint>

namespace skerry::client {

inline constexpr std::uint64_t kLookEvery = 1024;  // items

}  // namespace skerry::client
