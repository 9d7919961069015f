#include "server/world/ship_reading.hpp"

#include <cmath>

#include "echo/kernel/hash.hpp"

namespace skerry::server {

SensorReading reading_at(const WorldState& state, const ShipState& own_ship, Duration into) {
  if (own_ship.faults == nullptr) return {};
  const double of_exercise = own_ship.pace * static_cast<double>(into.count());
  const Duration now = state.exercise + Duration(std::llround(of_exercise));
  return reading_of(own_ship.faults.get(), now,
                    echo::mixed(state.scenario->seed(), own_ship.number, 0x5E150F));
}

double stamped_heading(const ShipState& own_ship, const SensorReading& reading,
                       double heading_deg) {
  if (reading.no_heading && own_ship.faults->held_heading_deg) {
    return *own_ship.faults->held_heading_deg;
  }
  return heading_deg + reading.heading_deg;
}

GeoPoint stamped_position(const ShipState& own_ship, const SensorReading& reading,
                          GeoPoint position) {
  if (reading.no_position && own_ship.faults->held_position) return *own_ship.faults->held_position;
  return moved_by(position, reading);
}

}  // namespace skerry::server
