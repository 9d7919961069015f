// Traffic: the ships among the targets, as the exercise moves them and an instructor orders them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/exercise.pb.h"
#include "server/world/environment.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// A copy is a snapshot.  All times are on the exercise's clock, since its begin.  Equal scenarios
// and orders at equal steps make equal ships, bit for bit, on every machine.
// Thread: one at a time.
class Traffic {
 public:
  // The ships among the scenario's targets; a ship's number is her place in that list.
  explicit Traffic(const scenario::Scenario& scenario);
  ~Traffic();
  Traffic(const Traffic& other);
  Traffic& operator=(const Traffic& other);

  // From `now` to `now + tick`, as the exercise is at `now`.
  void step(Duration now, Duration tick, const std::vector<ShipState>& own_ships,
            const Environment& environment);

  // The ships that are on the water at `now`, which step() has reached and is not a tick beyond;
  // in the order of their numbers.  `pace` is left at 1.
  std::vector<ShipState> states(Duration now) const;
  // One of them; nothing if she is not on the water.
  std::optional<ShipState> state(std::size_t number, Duration now) const;

  // What is wrong with an order: no such ship, a route with too many or too long legs, a speed
  // beyond her class.  Values within the ranges of exercise.proto.
  std::optional<std::string> fault_of(const wire::TargetChange& change) const;
  // Takes effect with the next step.  Requires that fault_of() has none.
  void order(const wire::TargetChange& change, Duration now);

  // A ship that was not there.  `target` as scenario.cpp would have it: with her class's sizes.
  void add(const scenario::Target& target, std::size_t number, Duration now);

  // All that is known of one ship but her motion: class, route left, behaviour, AIS faults.
  // Requires a number of a ship.
  void tell(std::size_t number, Duration now, wire::ExerciseShip& ship) const;
  bool has(std::size_t number) const;

  // For undo: a ship as she is, and back to it.
  class Kept;
  std::shared_ptr<const Kept> keep(std::size_t number) const;
  void put_back(const Kept& kept);

 private:
  struct Ship;
  std::uint64_t seed_;
  Duration reached_{};                                  // the end of the last step
  std::map<std::size_t, std::shared_ptr<Ship>> ships_;  // copied deep with this
};

}  // namespace skerry::server
