// How radars' threads stand among others.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace skerry::server {

// An antenna does not wait for a web page: its thread goes before others where the system lets it
// (as root or with CAP_SYS_NICE), and is an ordinary one where not.
inline constexpr int kRadarNiceness = -10;
inline void go_before_others() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kRadarNiceness);
}

// A thread that a radar's thread has started, and that may wait.
inline void go_with_others() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 0); }

}  // namespace skerry::server
