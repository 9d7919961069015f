// The scenario file's units as this project's.
#pragma once

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/length.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// 1 kn = 1 NM per hour exactly.
constexpr double knots_in_mps(double knots) {
  return knots * Length::kMetresPerNauticalMile / 3600.0;
}

// Of a Position or a Waypoint.
template <typename Position>
GeoPoint geo_point(const Position& position) {
  return {position.lat(), wrapped_longitude(position.lon())};
}

}  // namespace skerry::server
