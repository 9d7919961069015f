// World: all that a scenario holds, tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/exercise.pb.h"
#include "server/world/contacts.hpp"
#include "server/world/exercise_clock.hpp"
#include "server/world/exercise_events.hpp"
#include "server/world/own_ship.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/target_track.hpp"
#include "server/world/traffic/traffic.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Tick k is at scenario time k * kTick on the air, and a pure function of the scenario, of the
// orders, fixes and changes of the environment, and of the ticks at which they were given: two runs
// on one machine agree bit for bit.
//
// The exercise has a clock of its own, which goes at its rate while radars turn as ever.  Ships are
// moved in steps of kTick of that clock: at any rate they take the same way, bit for bit.
// Thread: one at a time; Timeline shares it.
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
  std::size_t own_ship_count() const { return part_.own_ships.size(); }
  WorldState state() const;
  // Cost: about 1 us per own ship (8 us with a class); targets cost nothing before state(), and
  // there about 1 us for each that makes way.  All that for each tick of the exercise.
  void step();
  // Ticks of the exercise that the next step() will make, at most.
  std::size_t ticks_ahead() const;

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
  EnvironmentPtr environment() const { return part_.environment; }
  void set_environment(Environment environment);

  // An instructor's order; takes effect with the next tick, and is undone or restored likewise.
  // Requires values within the ranges of exercise.proto.  What is wrong: nothing is then ordered.
  static constexpr std::size_t kMaxSnapshots = 16, kMaxUndo = 100;
  static constexpr std::size_t kMaxText = 500, kMaxMark = 200, kMaxName = 64;
  std::optional<std::string> fault_of(const wire::ExerciseOrder& order) const;
  void order(const wire::ExerciseOrder& order, const std::string& by);
  // Every ship as she is, the clock and what has happened.
  void tell(wire::ExerciseState& state) const;
  // Collisions and groundings are told in the log, and stop the exercise's clock if its sheet says
  // so: at the end of the step in which they were.  A ship runs aground where she has a class and
  // the water is no deeper than her draught; at the shore, by ExerciseOrder.aground of whoever
  // knows the chart (server/app/shore_watch.hpp).  A ship that is driven from outside is told
  // aground and goes on.
  //
  // When an event of the scenario happened, on the exercise's clock; nothing if it has not.
  std::optional<Duration> happened(const std::string& event) const {
    return part_.events.happened(event);
  }

 private:
  struct Drift {
    TargetTrack way;
    std::size_t number = 0;
    double height_m = 0.0;
  };
  // What a snapshot keeps.
  struct Part {
    ExerciseClock clock;
    std::int64_t steps = 0;                              // of kTick of the exercise
    std::shared_ptr<const scenario::Scenario> scenario;  // with the targets that were added
    std::vector<OwnShip> own_ships;
    Traffic traffic;
    EnvironmentPtr environment;
    ExerciseEvents events;
    Contacts contacts;
  };
  // What was before a change.
  struct PutBack {
    std::uint32_t own_ship;
    ShipState before;
  };
  struct FaultsBack {
    std::uint32_t own_ship;
    wire::Faults before;
  };
  struct Undo {
    std::string what;
    std::variant<EnvironmentPtr, std::shared_ptr<const Traffic::Kept>, PutBack, FaultsBack,
                 std::size_t>
        before;  // a number: that of a target which was not there
  };

  void step_exercise();
  void happen(const scenario::Event& event);
  std::optional<std::string> fault_of_new(const wire::NewTarget& target) const;
  // Each says what it has done.
  std::string add_target(const wire::NewTarget& target);
  std::string put(const wire::OwnShipPut& put);
  std::string set_faults(const wire::FaultChange& change);
  void say(std::optional<std::uint32_t> own_ship, const std::string& text);
  void mark(const std::string& kind, const std::string& text) { mark(kind, text, part_.clock.now); }
  void mark(const std::string& kind, const std::string& text, Duration when);
  // After a step: what touched, and who has too little water.
  void look_for_mishaps(Duration now);
  // By the shore, as an order has it.
  std::string ground(std::size_t own_ship);
  // Tells it; true if the exercise's clock stops for it.
  bool record(Contact contact);
  void take_snapshot(const std::string& name);
  void restore(const std::string& name);
  void undo();
  void remember(std::string what, decltype(Undo::before) before);
  ShipState own_ship_at(std::size_t number) const;
  // The log, to be changed.
  ExerciseLog& log();
  Duration since_step() const { return part_.clock.now - kTick * part_.steps; }

  std::uint64_t tick_ = 0;
  Part part_;
  std::size_t scripted_targets_;
  std::vector<Drift> adrift_;  // small targets that make way
  std::vector<Drift> sarts_;
  std::map<std::string, std::shared_ptr<const Part>> snapshots_;
  std::deque<Undo> undo_;
  std::shared_ptr<const ExerciseLog> log_;
};

}  // namespace skerry::server
