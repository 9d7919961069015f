// Spokes packed by their differences: the compact mode (RECORDING.md).
#pragma once

#include "protocol/quantity/time.hpp"

namespace skerry::recording {

// From the first spoke of a message to its last.
inline constexpr Duration kMaxPackedSpan = std::chrono::seconds(1);

}  // namespace skerry::recording
