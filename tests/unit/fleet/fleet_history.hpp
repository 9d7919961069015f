// A fleet at work in simulated time: hosts with clocks of their own, a store, and a network that
// loses, delays and cuts, all from one seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"

namespace skerry::fleet {

// What is broken on purpose, to see that the checks see it.
enum class Sabotage : std::uint8_t {
  none,
  no_fence,       // the store does not compare revisions
  any_grant,      // orders do not name the grant they were made for
  loose_grants,   // grants do not name the grant before them
  trusted_reply,  // a leader takes the store's reply for the grant
  runs_ahead,     // hosts do not keep to grants
  silent,         // hosts that must come back do not say so
  twice,          // an append is repeated under a new id
};

struct HistoryPlan {
  std::uint64_t seed = 1;
  std::size_t hosts = 4;
  Duration length = std::chrono::seconds(40);
  Sabotage sabotage = Sabotage::none;
};

struct History {
  std::vector<std::string> violations;  // the first ones
  std::uint64_t acknowledged = 0, refused = 0, abandoned = 0;
  std::uint64_t overtaken = 0;     // appends that came after a newer grant
  std::uint64_t deposed = 0;       // appends and grants under an epoch that was over
  std::uint64_t late_replies = 0;  // of grants that were heard in the log before
  std::uint64_t free_runs = 0, conflicts = 0, came_back = 0, reborn = 0, leaders = 0;
  std::uint64_t ticks_followed = 0, ticks_free = 0;
};

History run_history(const HistoryPlan& plan);

}  // namespace skerry::fleet
