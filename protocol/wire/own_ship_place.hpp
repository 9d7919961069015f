// What is known of own ship.
#pragma once

#include <optional>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/own_ship.pb.h"

namespace skerry::wire {

// Nothing if nobody knows: a recording may not tell.
inline std::optional<GeoPoint> place_known_of(const OwnShip& ship) {
  if (ship.no_position()) return std::nullopt;
  return GeoPoint{ship.latitude_deg(), ship.longitude_deg()};
}

// Recordings of other makers' radars say no more than that her motion is unknown: all of it is
// then. They call her driven.
inline bool knows_no_motion_at_all(const OwnShip& ship) {
  return ship.no_motion() && ship.driven();
}
// Her speed through the water.
inline bool knows_log(const OwnShip& ship) {
  return !ship.no_log() && !knows_no_motion_at_all(ship);
}
// Her rate of turn, which the compass tells.
inline bool knows_turn(const OwnShip& ship) {
  return !ship.no_heading() && !knows_no_motion_at_all(ship);
}

}  // namespace skerry::wire
