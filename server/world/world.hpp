// World: every ship of a scenario, in ticks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/world/own_ship.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/target_track.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Begins at ScenarioTime{}.  The same scenario, steps and orders give the same bits.
// Thread: one; Timeline shares it.
class World {
 public:
  static constexpr Duration kTick = std::chrono::milliseconds(100);

  // Requires what load_scenario() checks.
  // Error: std::invalid_argument as OwnShip.
  explicit World(const scenario::Scenario& scenario);

  std::int64_t ticks() const { return ticks_; }  // since the start
  ScenarioTime time() const { return ScenarioTime(ticks_ * kTick); }

  // At the beginning of the tick to come.  Speeds and rates of turn are means over that tick: each
  // ship moves through it as dead_reckoning.hpp has it, to where the next state finds her; only a
  // target that passes a waypoint in it is up to a tick's way off.  Ordered course and speed of a
  // target are her own.
  WorldState state() const;

  // One tick on.  Cost: 1 us per own ship.
  void step();

  // `ticks` on at once, whatever their number: OwnShip::leap() says how.
  void leap(std::int64_t ticks);

  // As OwnShip::order().
  // Error: std::out_of_range if there is no such own ship.
  void order(std::size_t own_ship, std::optional<double> course_deg,
             std::optional<double> speed_mps);

 private:
  struct Target {
    TargetTrack track;
    ShipState state;  // its name and size
  };

  std::int64_t ticks_ = 0;
  std::vector<OwnShip> own_ships_;
  std::vector<Target> targets_;
};

}  // namespace skerry::server
