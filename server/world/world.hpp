// World: all that a scenario holds, tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/world/own_ship.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/target_track.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Tick k is at scenario time k * kTick, and a pure function of the scenario, of the orders,
// fixes and changes of the environment, and of the ticks at which they were given: two runs on one
// machine agree bit for bit. Thread: one at a time; Timeline shares it.
class World {
 public:
  static constexpr Duration kTick = std::chrono::milliseconds(100);
  // Limits of ordered speeds, as in scenario.proto.
  static constexpr double kMinSpeedKn = -10.0, kMaxSpeedKn = 60.0;

  // Limits of a fix: beyond what any ship does, so that only nonsense is refused.
  static constexpr double kMaxDrivenSpeed_mps = 100.0, kMaxDrivenTurn_deg_min = 1200.0;

  // Requires a scenario that load_scenario() would accept.
  explicit World(const scenario::Scenario& scenario);

  std::uint64_t tick() const { return tick_; }
  std::size_t own_ship_count() const { return own_ships_.size(); }
  WorldState state() const;
  // Cost: about 1 us per own ship; targets cost nothing before state(), and there about 1 us for
  // each that makes way.
  void step();

  // Takes effect with the next tick; what is not given stays as ordered.
  // Error: std::invalid_argument, nothing ordered, if there is no such own ship, the course is not
  // finite or the speed not within kMinSpeedKn..kMaxSpeedKn.
  void order(std::size_t own_ship, std::optional<double> course_deg,
             std::optional<double> speed_kn);
  // The same from her con: of a ship that has a class, and only what it can do; values are within
  // the ranges of conning.proto.  `take` and `release` are not looked at.
  void order(std::size_t own_ship, const wire::ConOrder& order);
  // What order() would refuse.
  std::optional<std::string> fault_of(std::size_t own_ship, const wire::ConOrder& order) const;

  // An own ship's state at `now` as an outside simulator has it; takes effect with the next tick.
  // True if she was not driven until now.  Error: as order(), of values outside OwnShipFix's
  // ranges.
  bool drive(std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now);

  // In force from the present tick on.  Requires values within the ranges of scenario.proto.
  EnvironmentPtr environment() const { return environment_; }
  void set_environment(Environment environment);

 private:
  struct Track {
    TargetTrack way;
    std::size_t number;
    RadarSetPtr radar;
  };
  struct Drift {
    TargetTrack way;
    double height_m;
  };
  std::uint64_t tick_ = 0;
  std::vector<OwnShip> own_ships_;
  std::shared_ptr<const scenario::Scenario> scenario_;
  std::vector<Track> ships_;   // among the targets
  std::vector<Track> adrift_;  // small targets that make way
  std::vector<Drift> sarts_;
  EnvironmentPtr environment_;
};

}  // namespace skerry::server
