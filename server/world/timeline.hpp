// Timeline: the world's states in time, shared by all threads.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/world/world.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Makes each tick once, when someone first asks for it, and keeps the last kKept (3.2 s).
//
// Thread: any.  One mutex, held for a pointer copy when the tick exists, and for the making of
// ticks when not: some tens of microseconds per tick of one own ship and a dozen targets.  A call
// makes at most kMaxShipSteps steps of own ships (an exercise in haste makes several a tick), so
// that after hours of suspension nobody waits for more than some 10 ms (40 ms of ships with a
// class): at() then returns the newest state made, and the calls that follow catch up, an hour of
// two own ships in 15 of them.
class Timeline {
 public:
  static constexpr std::size_t kKept = 32;
  static constexpr std::uint64_t kMaxShipSteps = 5000;

  explicit Timeline(World world);

  // The state of the tick that contains `t`: state->time <= t < state->time + World::kTick.  For an
  // older t than is kept, the oldest kept.  Never nullptr.
  WorldStatePtr at(ScenarioTime t);

  // The newest state made; at first that of time 0.
  WorldStatePtr latest() const;

  // For hosts that agree on the ticks at which orders hold.  From now on ticks beyond `last` are
  // not made: at() then gives the newest made.  At first there is no last one.
  void keep_to(std::uint64_t last);
  // Makes all ticks up to `tick`, or to the last that may be made: what is ordered next holds from
  // the tick behind it on.  Others wait as for at(), however far it is.
  void make(std::uint64_t tick);

  // Takes effect with the next tick not yet made; returns its number, so that a run can be
  // repeated. Error: as World::order().
  std::uint64_t order(std::size_t own_ship, std::optional<double> course_deg,
                      std::optional<double> speed_kn);

  // Says instead what is wrong, and then orders nothing: a ship may have come to the end of her
  // route since fault_of() was asked.
  struct ConOrdered {
    std::uint64_t tick = 0;
    std::optional<std::string> fault = std::nullopt;
  };
  ConOrdered order(std::size_t own_ship, const wire::ConOrder& order);
  std::optional<std::string> fault_of(std::size_t own_ship, const wire::ConOrder& order) const;

  // Takes effect with the next tick not yet made, which is named; otherwise as World::drive().
  struct Driven {
    std::uint64_t tick = 0;
    bool begins = false;  // she was not driven until now
  };
  Driven drive(std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now);

  // An instructor's order, likewise; `by`: who gave it.
  ConOrdered order(const wire::ExerciseOrder& order, const std::string& by);
  std::optional<std::string> fault_of(const wire::ExerciseOrder& order) const;
  // A copy of the world at the newest tick made.
  World world() const;
  // Another world in its place, as of an earlier tick: what was ordered since then is undone.
  void restore(World world);
  // Every ship as of the newest tick made, and what has happened.
  void tell(wire::ExerciseState& state) const;

  // In force from the next tick not yet made on, whose number is returned.  Requires what
  // World::set_environment() does.  Whoever changes what environment() gives must keep others from
  // doing so meanwhile.
  EnvironmentPtr environment() const;
  std::uint64_t set_environment(Environment environment);

 private:
  void make_up_to(std::uint64_t tick);

  mutable std::mutex mutex_;
  World world_;
  std::uint64_t last_ = std::numeric_limits<std::uint64_t>::max();
  std::array<WorldStatePtr, kKept> kept_;  // tick k at k % kKept
};

}  // namespace skerry::server
