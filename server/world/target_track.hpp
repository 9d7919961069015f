// TargetTrack: a target's way, as a function of time.
#pragma once

#include <GeographicLib/GeodesicLine.hpp>
#include <cstddef>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Without waypoints: a rhumb line at constant course and speed for ever; over a pole it goes on
// straight (rhumb_step.hpp).  With waypoints: geodesic legs in order at constant speed, turning at
// once at each, then stopped at the last with the last heading.
// Each position follows from the start alone, nothing adds up.
// Error: GeographicLib's, 1e-7 m, whatever the time.  Immutable.  Thread: any.
class TargetTrack {
 public:
  // Requires what load_scenario() checks.
  explicit TargetTrack(const scenario::Target& target);

  // The target `since_start` after scenario time 0; before it, she lies at her start.
  ShipState at(Duration since_start) const;
  // The waypoints that she has passed by then.
  std::size_t passed_at(Duration since_start) const;

 private:
  struct Leg {
    double start_m;  // along the whole way
    double length_m;
    GeographicLib::GeodesicLine line;
  };
  void sail_legs(double way_m, ShipState& ship) const;

  ShipState start_;
  std::vector<Leg> legs_;
};

}  // namespace skerry::server
