// TrafficShip: a ship among the targets, as the scenario has her sail and an instructor orders her.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/exercise.pb.h"
#include "server/world/environment.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/target_track.hpp"
#include "server/world/traffic/anchor_swing.hpp"
#include "server/world/traffic/fishing_legs.hpp"
#include "server/world/traffic/give_way.hpp"
#include "server/world/traffic/logged_track.hpp"
#include "server/world/traffic/route_pilot.hpp"
#include "server/world/traffic/station.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Whom a ship follows.
struct Leader {
  std::size_t number = 0;
  bool own = false;
};

// A ship without a key of traffic and without an order is a TargetTrack, bit for bit.  With the
// first of either she is stepped: rate of turn and speed follow by first order (ship_answer.hpp),
// and she moves by position_at() of the very state that she reports, so that it leads to the next.
// Her heading is her course over ground, but at anchor.  A ship of a log (logged_track.hpp) is on
// the water while the log has her, and sails as it has her until she is ordered otherwise.
// A copy is a snapshot.  All times are on the exercise's clock.  Thread: one at a time.
class TrafficShip {
 public:
  // `begin`: when she is where the target says.
  TrafficShip(const scenario::Target& target, std::size_t number, std::uint64_t seed,
              std::optional<Leader> leader, Duration begin, const Environment& environment);

  // At `now`, which is not a tick after `reached`, the last step's end.
  ShipState state(Duration now, Duration reached) const;
  bool is_on_water(Duration now) const;

  // A step has two parts, so that all see each other at the same time: she moves, then she makes up
  // her mind about the tick from `now` on.
  void advance(Duration tick);
  // Whether she looks round for others with the tick that begins at `now`.
  bool looks(Duration now, Duration tick) const;
  std::optional<Leader> follows() const;
  void plan(Duration now, Duration tick, const Environment& environment,
            std::span<const SeenShip> others, const ShipState* leader);

  SeenShip seen(Duration now) const;

  std::optional<std::string> fault_of(const wire::TargetChange& change, Duration now) const;
  void order(const wire::TargetChange& change, Duration now);
  void tell(Duration now, wire::ExerciseShip& ship) const;

 private:
  enum class Way : std::uint8_t { track, log, course, route, anchor, station, fishing };

  bool is_off_route() const { return ordered_course_deg_ || ordered_speed_mps_; }
  // Whether her place follows from the time alone.
  bool is_plotted() const { return way_ == Way::track || way_ == Way::log; }
  ShipState plotted(Duration now) const;
  std::size_t passed_at(Duration now) const;
  void become_stepped(Duration now);
  void take_route(const wire::TargetChange& change, Duration now);
  RouteOrder wish(Duration now, const ShipState* leader, Wanted& wanted);
  void lie_at_anchor(Duration now, Duration tick, const Environment& environment);
  void evade(bool looks_round, std::span<const SeenShip> others, const Visibility& visibility,
             RouteOrder& order);

  std::shared_ptr<const scenario::Target> target_;
  std::shared_ptr<const TargetTrack> track_;
  std::shared_ptr<const LoggedTrack> log_;
  std::size_t number_;
  Duration begin_;
  ShipAnswer answer_;
  Way way_ = Way::track;
  wire::GiveWay gives_way_ = wire::GIVE_WAY_NEVER;
  double start_s_ = 0.0;
  double course_deg_ = 0.0, speed_mps_ = 0.0;  // of a ship that keeps them
  std::optional<Leader> leader_;
  Station station_;
  std::optional<RoutePilot> route_;
  std::optional<AnchorSwing> swing_;
  std::optional<FishingLegs> fishing_;

  std::optional<double> ordered_course_deg_, ordered_speed_mps_;
  std::optional<Evasion> evasion_;
  bool removed_ = false;
  ShipState state_;  // of the present tick, once she is stepped
  WayAndTurn end_;   // what she has at its end
};

// The speed that a ship of this target can do at most, m/s.
double most_speed_mps(const scenario::Target& target);

}  // namespace skerry::server
