#include "server/fleet/host_clock.hpp"

#include <time.h>

namespace skerry::fleet {

HostTime host_now() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return HostTime(std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec));
}

}  // namespace skerry::fleet
