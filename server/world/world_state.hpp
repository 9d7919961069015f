// WorldState: where every ship is and how it moves, at one instant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Motion is straight or a steady turn from `time` of the WorldState on: good for one tick.
struct ShipState {
  std::string name;
  GeoPoint position;
  double heading_deg = 0.0;             // true, [0, 360)
  double course_over_ground_deg = 0.0;  // true, [0, 360)
  double speed_mps = 0.0;               // over ground, along the course; astern negative
  double rate_of_turn_deg_s = 0.0;      // starboard positive
  double ordered_course_deg = 0.0;
  double ordered_speed_mps = 0.0;
  double length_m = 0.0;
  double beam_m = 0.0;
  double height_m = 0.0;  // of the echoing hull and superstructure above the water
};

struct WorldState {
  ScenarioTime time{};
  std::vector<ShipState> own_ships;
  std::vector<ShipState> targets;
  double water_level_m = 0.0;  // over the charted coastline, 0 or less
  double wave_height_m = 0.0;  // significant
};
using WorldStatePtr = std::shared_ptr<const WorldState>;

}  // namespace skerry::server
