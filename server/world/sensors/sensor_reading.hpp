// SensorReading: how far an own ship's sensors are off, by the faults ordered.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "server/world/sensors/fault_state.hpp"

namespace skerry::server {

// What is added to the truth.  Nothing is NaN, and all is within the bounds stated.
struct SensorReading {
  bool no_heading = false, no_position = false, no_log = false, no_wind = false, no_ais = false;
  double heading_deg = 0.0;            // (-180, 180]
  double rate_of_turn_deg_min = 0.0;   // a drifting gyro turns: within 60
  double log_kn = 0.0;                 // within 20 + 6 * 5
  double north_m = 0.0, east_m = 0.0;  // each within kFarthestOffM
  // How fast the position runs away: of course and speed over ground.  60 kn at most.
  double drift_north_mps = 0.0, drift_east_mps = 0.0;
  double wind_kn = 0.0, wind_deg = 0.0;  // of the anemometer, which is on the ship

  bool moves_position() const { return north_m != 0.0 || east_m != 0.0; }
  friend bool operator==(const SensorReading&, const SensorReading&) = default;
};

// A position that has run so far stays there.
inline constexpr double kFarthestOffM = 200'000.0;

// At a moment of the exercise's clock.  Gyro: bias + drift * time since the drift was ordered +
// noise; GNSS likewise north and east.  Noise is another one every tenth of a second of that clock,
// the sum of twelve equal shares less six times a standard deviation: nearly normal, and never more
// than six deviations.  What is lost has no error.  Blackout loses all.
// Null: no faults, all zero.  A pure function with the same bits on every machine.
SensorReading reading_of(const FaultState* faults, Duration exercise_now, std::uint64_t seed);

// What a receiver says that is off by so much: along meridian and parallel of a sphere.
// Error: 0.6 % of the offset, which is itself a fault's; a parallel near a pole counts as 0.01 of
// the equator.  Latitudes end at the poles.
GeoPoint moved_by(GeoPoint position, const SensorReading& reading);

}  // namespace skerry::server
