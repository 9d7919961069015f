// Where own ship is.
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

}  // namespace skerry::wire
