// Tracked targets as Signal K displays are told of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/signalk/json.hpp"

namespace skerry::signalk {

// A place at sea, how it moves over ground.
struct Movement {
  GeoPoint position;
  double course_deg = 0.0;  // true
  double speed_mps = 0.0;
};

struct RangeAndBearing {
  double range_m = 0.0;
  double bearing_deg = 0.0;  // true, [0, 360)
};

// From one place to another within some 100 NM: the great circle, stretched to the ellipsoid's
// curvature in between.  Error against the geodesic: below 5e-5 of the range and 0.004 deg up to
// 96 NM and latitude 75 (Target.RangeAndBearingAgreeWithTheGeodesic).
RangeAndBearing range_and_bearing(GeoPoint from, GeoPoint to);

// The nearest the two come if both go on as they do; nothing if they draw apart or keep their
// distance.
struct ClosestApproach {
  double distance_m = 0.0;
  double seconds = 0.0;
};
std::optional<ClosestApproach> closest_approach(const Movement& own, const Movement& other);

struct Target {
  std::uint32_t number = 0;
  Movement movement;
  bool acquired_by_hand = false;
  UtcTime first_seen{}, last_seen{};
};
Json target_document(const Target& target, const Movement& own);

// "2026-11-21T08:15:30.250Z"
std::string iso_time(UtcTime time);

}  // namespace skerry::signalk
