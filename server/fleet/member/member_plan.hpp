// MemberPlan: as what a host joins an exercise.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// At most so long a thread of the member waits for one call of the store; for an append 1 s, for
// the whole log 10 s.  stop() waits as long.
inline constexpr std::chrono::milliseconds kStoreCall{500};

struct MemberPlan {
  std::string exercise, host;  // names, as LogKeys has them
  std::size_t ships = 0;       // own ships of the scenario
  // What all hosts must agree on, a line each: "scenario 5f3a...".  The first host's stand in the
  // store; one whose lines are others is refused.
  std::vector<std::string> charter;
  std::string native, web;  // where this host's clients connect to
  // A way to the store, one for each thread.  Must not throw.
  std::function<std::unique_ptr<KeyStore>()> store;
};

}  // namespace skerry::fleet
