// What the sensors of a ship of a WorldState say.
#pragma once

#include "server/world/dead_reckoning.hpp"
#include "server/world/sensors/sensor_reading.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// `into` the tick of the state, on the air.  Spokes, displays and sentences of one moment get the
// same.
SensorReading reading_at(const WorldState& state, const ShipState& own_ship, Duration into);

// Heading and position as they are stamped on spokes, of the truth at that moment.  Those of a lost
// gyro or receiver stay what they were last: a spoke cannot do without.
double stamped_heading(const ShipState& own_ship, const SensorReading& reading, double heading_deg);
GeoPoint stamped_position(const ShipState& own_ship, const SensorReading& reading,
                          GeoPoint position);

}  // namespace skerry::server
