// Timeline: the world's states, made as they are asked for, shared by all radars.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/world/world.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Holds the newest kKept states, ticks without a gap.  The world advances when a time is asked for
// that lies beyond them.  An asker far behind the others gets an older state than it would like but
// never makes anybody wait.
//
// A jump forward of more than kMaxFineTicks, as after the machine slept, is leapt over
// (World::leap()): its cost does not grow with its length and stays below 1 ms per own ship.  Any
// other call costs what its ticks do, 1 us per own ship, and 1 us per target for each state kept.
// A leap does not give the bits that single ticks would have given; all else does.
// Thread: any.
class Timeline {
 public:
  static constexpr std::size_t kKept = 32;
  static constexpr std::int64_t kMaxFineTicks = 600;

  explicit Timeline(World world);

  // Of the tick that holds `t`; the oldest kept if that is gone.
  WorldStatePtr at(ScenarioTime t);

  // As World::order(): shows in the first state not yet made.
  void order(std::size_t own_ship, std::optional<double> course_deg,
             std::optional<double> speed_mps);

  WorldStatePtr latest() const;

 private:
  void advance_to(std::int64_t tick);

  mutable std::mutex mutex_;
  World world_;
  std::deque<WorldStatePtr> kept_;  // never empty; the last is of world_
};

}  // namespace skerry::server
