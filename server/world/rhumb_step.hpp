// A step along a rhumb line: the track of a ship that keeps her course.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

struct RhumbEnd {
  GeoPoint position;
  bool over_pole = false;  // the course is then reversed: who sails north over the pole sails south
};

// The place of a ship after `distance_m` (negative: astern) on the constant true course
// `course_deg`, on the WGS-84 ellipsoid.  A track that reaches a pole goes on straight, down the
// meridian opposite to the one it came on (exact for courses 000 and 180; a slanting rhumb line
// winds around the pole without end and comes out on any meridian).
//
// Up to 50 m and 80 deg of latitude it is short_way.hpp's, with the same bits on every machine.
// A distance of 0 returns `from` exactly: a ship that lies still does not creep by rounding.
// Error: that of GeographicLib::Rhumb, under 1e-7 m, and the rounding of degrees, 3e-9 m; 36 000
// steps of one hour add up to less than 1e-3 m.  Held by RhumbStep.AnHourOfTicksIsOneRhumbLine.
// Always finite and within [-90, 90] and [-180, 180) for finite arguments, |distance_m| < 2e7.
// Source: Karney, On auxiliary latitudes, Survey Review 56 (2024).
RhumbEnd advanced(GeoPoint from, double course_deg, double distance_m);

}  // namespace skerry::server
