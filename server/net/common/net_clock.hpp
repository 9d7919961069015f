// The clocks that net reads, as the types of time that others take.
#pragma once

#include <chrono>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

inline UtcTime utc_now() {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

// For what wants a time that never jumps, and does not mind when it began.
inline ScenarioTime scenario_time(std::chrono::steady_clock::time_point time) {
  return ScenarioTime(std::chrono::duration_cast<Duration>(time.time_since_epoch()));
}

}  // namespace skerry::server
