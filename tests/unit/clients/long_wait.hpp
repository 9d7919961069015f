// The time limit of what a test waits for.
#pragma once

#include <chrono>

namespace skerry::client {

inline constexpr std::chrono::seconds kLong{20};  // never reached by a test that passes

}  // namespace skerry::client
