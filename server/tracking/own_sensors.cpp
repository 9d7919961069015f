#include "server/tracking/own_sensors.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/speed.hpp"
#include "protocol/wire/own_ship_place.hpp"
#include "server/navigation/target_geometry.hpp"

namespace skerry::server {
namespace {

PlanePoint motion(double course_deg, double speed_mps) {
  const echo::SinCos way = echo::sin_cos_degrees(course_deg);
  return {speed_mps * way.sin, speed_mps * way.cos};
}

}  // namespace

OwnSensors sensors_of(const wire::OwnShip& ship) {
  OwnSensors own;
  own.utc = UtcTime(Duration(static_cast<std::int64_t>(ship.utc_ns())));
  own.place = wire::place_known_of(ship);
  if (!ship.no_heading()) own.heading_deg = ship.heading_deg();
  if (!ship.no_motion()) {
    own.over_ground_mps =
        motion(ship.course_over_ground_deg(), ship.speed_over_ground_kn() * kKnot);
  }
  if (!ship.no_heading() && wire::knows_log(ship)) {
    const bool has_con = ship.has_con();
    const double ahead = has_con ? ship.con().water_ahead_kn() : ship.speed_kn();
    const double starboard = has_con ? ship.con().water_starboard_kn() : 0.0;
    const PlanePoint along = motion(ship.heading_deg(), ahead * kKnot);
    const PlanePoint across = motion(ship.heading_deg() + 90.0, starboard * kKnot);
    own.through_water_mps = along + across;
  }
  return own;
}

std::vector<AisContact> ais_contacts(std::span<const TrafficItem> traffic,
                                     const wire::OwnShip& own_ship, std::uint32_t radar) {
  std::vector<AisContact> contacts;
  if (own_ship.no_ais()) return contacts;
  const UtcTime now{Duration(static_cast<std::int64_t>(own_ship.utc_ns()))};
  const auto here = wire::place_known_of(own_ship);
  for (const TrafficItem& item : traffic) {
    const bool is_ship = item.kind == TrafficKind::ship || item.kind == TrafficKind::boat;
    const bool is_own =
        std::find(item.radars.begin(), item.radars.end(), radar) != item.radars.end() ||
        (item.mmsi != 0 && item.mmsi == own_ship.mmsi());
    if (!is_ship || is_own || item.mmsi == 0) continue;
    const AisSaid said = said_by_ais(item);
    if (said.silent || !said.position) continue;
    if (here && place_of(*said.position, *here).range_m > kAisReach_m) continue;
    contacts.push_back({.mmsi = item.mmsi,
                        .name = item.name,
                        .place = *said.position,
                        .course_deg = said.course_over_ground_deg,
                        .speed_mps = said.speed_mps,
                        .heading_deg = said.heading_deg,
                        .utc = now});
  }
  return contacts;
}

}  // namespace skerry::server
