// Track: a target that has been seen in several turns, where it is and how it moves.
#pragma once

#include <cstdint>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

enum class TrackStatus : std::uint8_t {
  tentative,  // not yet sure to be a target; not shown
  tracked,
  lost,  // told once, with its last place
};

struct PlottedTrack {
  std::uint32_t number = 0;  // from 1 up; another target never has it
  TrackStatus status = TrackStatus::tentative;
  // Of the state below.
  ScenarioTime time{};
  UtcTime utc{};
  // Over ground, as far as own ship's positions are: m and m/s east and north.
  GeoPoint place;
  PlanePoint velocity_mps;
  // From own ship, and in motion relative to it.
  GeoPoint own_ship;
  double range_m = 0.0;
  TrueBearing bearing;
  PlanePoint relative_velocity_mps;
  // Standard deviations: of the place and of the velocity, the larger of both axes.
  double place_sigma_m = 0.0, velocity_sigma_mps = 0.0;
  double length_m = 0.0, width_m = 0.0;  // of its echo, smoothed
  ScenarioTime first_seen{}, last_seen{};
  std::uint8_t looks = 0,
               hits = 0;  // of the last ten turns, those in which it was looked for and seen
  bool by_hand = false;   // acquired by a mariner
};

// Closest point of approach to own ship, if both keep on.  time_s is negative once it has passed;
// without relative motion it is 0 and the range is the present one.
struct PlottedApproach {
  double range_m = 0.0, time_s = 0.0;
  bool moves = false;  // relative speed of more than 0.05 m/s; else the time means nothing
};
PlottedApproach closest_approach(const PlottedTrack& track);
// Of what is there from own ship, m, and moves so against her, m/s.
PlottedApproach closest_approach(PlanePoint from_own_ship, PlanePoint relative_velocity_mps);

}  // namespace skerry::server
