// What an instructor is told of the world.
#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/world/ship_reading.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMarksTold = 100;  // as exercise.proto says
// Waypoints of one ship and of all: a message stays well below the longest frame.
constexpr int kMostOfAShip = 50, kMostOfAll = 10'000;

void tell_motion(const ShipState& ship, wire::ExerciseShip& told) {
  told.set_number(static_cast<std::uint32_t>(ship.number));
  told.set_name(ship.name);
  told.set_latitude_deg(ship.position.latitude_deg);
  told.set_longitude_deg(ship.position.longitude_deg);
  told.set_heading_deg(ship.heading_deg);
  told.set_course_over_ground_deg(
      wrapped_degrees(ship.course_over_ground_deg + (ship.speed_mps < 0.0 ? 180.0 : 0.0)));
  told.set_speed_kn(std::fabs(ship.speed_mps) / knots_in_mps(1.0));
  told.set_rate_of_turn_deg_min(60.0 * ship.rate_of_turn_deg_s);
  told.set_length_m(ship.length_m);
  told.set_beam_m(ship.beam_m);
  told.set_mmsi(ship.mmsi);
  told.set_ordered_course_deg(ship.ordered_course_deg);
  told.set_ordered_speed_kn(ship.ordered_speed_mps / knots_in_mps(1.0));
  told.set_sart(ship.sart);
}

void tell_log(const ExerciseLog& log, wire::ExerciseState& out) {
  for (const std::string& name : log.snapshots) out.add_snapshots(name);
  const std::size_t told = std::min(log.marks.size(), kMarksTold);
  for (std::size_t i = log.marks.size() - told; i < log.marks.size(); ++i) {
    *out.add_marks() = log.marks[i];
  }
  out.set_can_undo(log.can_undo);
  out.set_last_by(log.last_by);
  out.set_last_order(log.last_order);
  out.set_orders(log.orders);
}

}  // namespace

void World::tell(wire::ExerciseState& out) const {
  const WorldState now = state();
  out.set_exercise_s(in_seconds(now.exercise));
  out.set_frozen(now.frozen);
  out.set_rate(now.rate);
  for (const ShipState& ship : now.own_ships) {
    wire::ExerciseShip& told = *out.add_ships();
    tell_motion(ship, told);
    told.set_own(true);
    told.set_ship_class(part_.scenario->own_ships(static_cast<int>(ship.number)).ship_class());
    told.set_aground(ship.aground);
    if (ship.faults) *told.mutable_faults() = ship.faults->faults;
    const SensorReading reading = reading_at(now, ship, Duration::zero());
    told.set_gyro_error_deg(reading.heading_deg);
    told.set_gnss_error_m(std::hypot(reading.north_m, reading.east_m));
  }
  std::size_t next = 0;
  int waypoints = 0;
  for (int i = 0; i < part_.scenario->targets_size(); ++i) {
    const auto number = static_cast<std::size_t>(i);
    if (!part_.traffic.has(number)) continue;
    wire::ExerciseShip& told = *out.add_ships();
    told.set_number(static_cast<std::uint32_t>(i));
    told.set_name(part_.scenario->targets(i).name());
    if (next < now.targets.size() && now.targets[next].number == number) {
      tell_motion(now.targets[next++], told);
    } else {
      told.set_removed(true);
    }
    part_.traffic.tell(number, now.exercise, told);
    const int most = waypoints < kMostOfAll ? kMostOfAShip : 1;
    while (told.route_size() > most) told.mutable_route()->RemoveLast();
    waypoints += told.route_size();
  }
  tell_log(*log_, out);
}

}  // namespace skerry::server
