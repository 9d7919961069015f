// Several processes at work on one log, while members of the store and the processes themselves are
// killed, stopped and started again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"

namespace skerry::fleet {

struct TorturePlan {
  std::uint64_t seed = 1;
  Duration length = std::chrono::seconds(20);
  std::size_t workers = 4;
};

struct TortureReport {
  std::vector<std::string> contradictions;
  std::uint64_t done = 0, never = 0, unknown = 0;  // appends
  std::uint64_t deposed = 0;                       // of `never`
  std::uint64_t seen = 0;                          // orders that watches gave
  std::uint64_t troubles = 0;                      // that watches told
  std::uint64_t epochs = 0;                        // in the log
  std::uint64_t members_killed = 0, members_stopped = 0, workers_killed = 0, workers_stopped = 0;
  std::string text() const;
};

// Error: std::runtime_error, if etcd does not run.
TortureReport torture(const TorturePlan& plan);

}  // namespace skerry::fleet
