#include "server/app/traffic_list.hpp"

#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/app/told_ship.hpp"
#include "server/world/ais_identities.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/ship_reading.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

void put(const ShipState& ship, Duration dt, TrafficItem& item) {
  const ShipPlace place = position_at(ship, dt);
  item.position = place.position;
  item.heading_deg = place.heading_deg;
  item.course_over_ground_deg =
      wrapped_degrees(place.course_over_ground_deg + (ship.speed_mps < 0.0 ? 180.0 : 0.0));
  item.speed_mps = std::fabs(ship.speed_mps);
  item.rate_of_turn_deg_min = ship.rate_of_turn_deg_s * 60.0;
}

// Of an own ship with faults: what her AIS hears of her sensors.
std::optional<AisSaid> said_of(const WorldState& state, const ShipState& ship, Duration dt) {
  const SensorReading reading = reading_at(state, ship, dt);
  if (reading == SensorReading{}) return std::nullopt;
  AisSaid said;
  said.silent = ship.faults->faults.blackout();
  const wire::OwnShip told = told_ship(ship, position_at(ship, dt), reading);
  if (!told.no_heading()) {
    said.heading_deg = told.heading_deg();
    said.rate_of_turn_deg_min = told.rate_of_turn_deg_min();
  }
  if (told.no_position()) return said;
  said.position = GeoPoint{told.latitude_deg(), told.longitude_deg()};
  said.course_over_ground_deg = told.course_over_ground_deg();
  said.speed_mps = told.speed_over_ground_kn() * kKnot;
  return said;
}

TrafficKind kind_of(const scenario::Target& target) {
  switch (target.kind()) {
    case scenario::Target::ship:
      return target.ais_class() == scenario::class_b ? TrafficKind::boat : TrafficKind::ship;
    case scenario::Target::small_craft:
    case scenario::Target::reflector_craft:
      return TrafficKind::boat;
    default:
      return is_aid(target.kind()) ? TrafficKind::aid_to_navigation : TrafficKind::other;
  }
}

TrafficItem item_of(const scenario::OwnShip& ship) {
  TrafficItem item;
  item.name = ship.name();
  item.mmsi = ship.mmsi();
  item.length_m = ship.length_m();
  item.beam_m = ship.beam_m();
  item.ship_type = static_cast<std::uint8_t>(ship.ship_type());
  return item;
}

// The target's place at the start.
TrafficItem item_of(const scenario::Target& target) {
  TrafficItem item;
  item.kind = kind_of(target);
  item.name = target.name();
  item.mmsi = target.mmsi();
  item.position = geo_point(target.position());
  item.heading_deg = item.course_over_ground_deg = wrapped_degrees(target.course_deg());
  if (target.kind() == scenario::Target::ship) {
    item.length_m = target.length_m();
    item.beam_m = target.beam_m();
  }
  item.ship_type = static_cast<std::uint8_t>(target.ship_type());
  item.aid_type = static_cast<std::uint8_t>(target.aid_type());
  return item;
}

TrafficItem item_of(const scenario::Racon& racon) {
  TrafficItem item;
  item.kind = TrafficKind::aid_to_navigation;
  item.name = racon.name();
  item.mmsi = racon.mmsi();
  item.position = geo_point(racon.position());
  item.aid_type = static_cast<std::uint8_t>(scenario::racon_mark);
  return item;
}

// The same of a target whose AIS is off or errs; the place it tells is so far ahead of her own.
std::optional<AisSaid> said_of_target(const ShipState& ship, const TrafficItem& item) {
  if (!ship.ais_off && ship.ais_heading_error_deg == 0.0 && ship.ais_position_error_m == 0.0) {
    return std::nullopt;
  }
  AisSaid said = said_by_ais(item);
  said.silent = ship.ais_off;
  said.heading_deg = wrapped_degrees(item.heading_deg + ship.ais_heading_error_deg);
  said.position = advanced(item.position, item.heading_deg, ship.ais_position_error_m).position;
  return said;
}

}  // namespace

std::vector<TrafficItem> traffic_of(const WorldState& state, ScenarioTime now) {
  const Duration dt = now - state.time;
  const scenario::Scenario& scenario = *state.scenario;
  std::vector<TrafficItem> items;
  items.reserve(static_cast<std::size_t>(scenario.own_ships_size() + scenario.targets_size()) +
                static_cast<std::size_t>(scenario.racons_size()));
  const auto add = [&](TrafficItem item) {
    item.number = static_cast<std::uint32_t>(items.size()) + 1;
    items.push_back(std::move(item));
  };
  for (const scenario::OwnShip& ship : scenario.own_ships()) add(item_of(ship));
  for (const ShipState& ship : state.own_ships) {
    put(ship, dt, items[ship.number]);
    items[ship.number].ais = said_of(state, ship, dt);
  }
  const auto fill = [&](int number) {
    add(item_of(scenario.targets(number)));
    return items.size() - 1;
  };
  std::vector<std::size_t> places(static_cast<std::size_t>(scenario.targets_size()));
  const auto scripted = static_cast<int>(state.scripted_targets);
  for (int i = 0; i < scripted; ++i) places[static_cast<std::size_t>(i)] = fill(i);
  for (const scenario::Racon& racon : scenario.racons()) add(item_of(racon));
  // Behind all others, so that those keep their numbers.
  for (int i = scripted; i < scenario.targets_size(); ++i) {
    places[static_cast<std::size_t>(i)] = fill(i);
  }
  std::vector<bool> on_water(places.size(), false);
  for (const ShipState& ship : state.targets) {
    TrafficItem& item = items[places[ship.number]];
    put(ship, dt, item);
    item.ais = said_of_target(ship, item);
    on_water[ship.number] = true;
  }
  for (const SmallTargetState& small : state.adrift) {
    ShipState boat;
    boat.position = small.position;
    boat.heading_deg = boat.course_over_ground_deg = small.course_over_ground_deg;
    boat.speed_mps = small.speed_mps;
    boat.pace = small.pace;
    put(boat, dt, items[places[small.number]]);
  }
  for (std::size_t i = places.size(); i-- > 0;) {
    const bool is_ship = scenario.targets(static_cast<int>(i)).kind() == scenario::Target::ship;
    if (is_ship && !on_water[i]) items[places[i]].number = 0;
  }
  std::erase_if(items, [](const TrafficItem& item) { return item.number == 0; });
  return items;
}

}  // namespace skerry::server
