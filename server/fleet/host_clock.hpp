// HostClock: the clock of one host of the fleet.
#pragma once

#include <chrono>
#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::fleet {

// Time since the host was started.  It is never set, and it goes on while the host is suspended
// (CLOCK_BOOTTIME): a lease runs out then as well.  Hosts' clocks have nothing to do with each
// other but their rate.
struct HostClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  using time_point = std::chrono::time_point<HostClock, Duration>;
  static constexpr bool is_steady = true;
};
using HostTime = HostClock::time_point;

HostTime host_now();

}  // namespace skerry::fleet
