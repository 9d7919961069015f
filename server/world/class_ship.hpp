// ClassShip: an own ship of a class, as the world has her tick by tick.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/conning.pb.h"
#include "server/world/environment.hpp"
#include "server/world/handling/helmsman.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// What an environment is to a ship at a place and time.  Waves are the higher of those that the
// Douglas state has (0.05, 0.3, 0.88, 1.88, 3.25 and 5 m for 1 to 6, straight lines between) and
// the swell; the wind is that of the sea state, 3.16 state^0.8 m/s, unless it is given.
Surroundings surroundings_of(const Environment& environment, GeoPoint at, Duration since_start,
                             std::uint64_t seed);

// Each tick is integrated in two steps (ship_dynamics.hpp) while orders hold; the state that the
// world sees says her mean motion over the tick, so that position_at() leads exactly to the next.
// Faults of her machinery (ShipState.faults) act in the tick that they are there; what the con
// shows as ordered stays. Two steps a tick against twenty: after a day under an autopilot in sea
// state 4 at most 0.03 m for ships of 80 m and more and the tug.  There the smallest differ by up
// to 34 m, and as much after a nudge of 1e-9 kn: no step foretells them (manoeuvre_bench --day).
// Thread: one at a time.
class ClassShip {
 public:
  static constexpr int kStepsPerTick = 2;

  // Under way on her course and speed: on her route if she has one, else by autopilot.
  ClassShip(const ShipClass& ship, const scenario::OwnShip& scenario, std::uint64_t seed,
            int steps_per_tick = kStepsPerTick);

  // Take effect with the next tick.  Require values within the ranges of conning.proto.
  // Error: what is wrong, where a ship of this class cannot do it; nothing is then ordered.
  std::optional<std::string> fault_of(const wire::ConOrder& order) const;
  void order(const wire::ConOrder& order);
  void order_course(double course_deg);
  void order_speed(double speed_mps);

  // Gives the ship, at the begin of a tick, her motion in it.
  void begin_tick(const Environment& environment, Duration now, Duration tick, ShipState& ship);
  // As a simulator outside leaves her: on the heading and at the speed she has.
  void resume(const ShipState& ship);
  // Aground, from now on: begin_tick() moves a ship that is aground no more.
  void lie_still(ShipState& ship);
  // Over a pole.
  void reverse_course();

 private:
  TrackView track_from(GeoPoint position);
  void tell(const Surroundings& around, ShipState& ship) const;

  const ShipClass& class_;  // of the table, for ever
  std::uint64_t seed_;
  int steps_per_tick_;
  DynamicState state_;
  HelmOrders helm_;
  Helmsman helmsman_;
  ActuatorOrders conn_;  // in force in this tick
  WayMade ground_;       // per second, in the last tick
  std::vector<GeoPoint> route_;
  std::size_t leg_ = 0;  // makes for route_[leg_]; at the end: its size
  GeoPoint leg_from_;
  double cross_track_m_ = 0.0, left_m_ = 0.0;
};

}  // namespace skerry::server
