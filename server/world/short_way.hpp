// Short ways on the ellipsoid, with the same bits on every machine.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// No degree of latitude, and none of the equator, is shorter: for what may be near.
inline constexpr double kLeastDegree_m = 110'000.0;

// Metres to the north and to the east.
struct ShortWay {
  double north_m = 0.0, east_m = 0.0;
};

// The place after a way along a rhumb line, by the middle latitude on WGS-84.  For ways of up to
// 50 m within 80 deg of latitude: off by less than 1e-8 m; longer ones by the cube of their length.
// Held by ShortWay.IsARhumbLine.
GeoPoint advanced(GeoPoint from, ShortWay way);
inline constexpr double kShortWay_m = 50.0, kShortWayLatitude_deg = 80.0;

// The way from one place to another along a rhumb line, the shorter way round.  Off by 1e-4 of its
// length at 100 NM in 60 deg of latitude, less when shorter: for steering by.
ShortWay short_way_between(GeoPoint from, GeoPoint to);
inline PlanePoint plane_way_between(GeoPoint from, GeoPoint to) {
  const ShortWay way = short_way_between(from, to);
  return {way.east_m, way.north_m};
}

}  // namespace skerry::server
