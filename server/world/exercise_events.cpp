#include "server/world/exercise_events.hpp"

#include <cmath>

#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

Duration minutes_of(double minutes) {
  return Duration(static_cast<std::int64_t>(std::llround(minutes * 60e9)));
}

double metres_between(GeoPoint a, GeoPoint b) {
  const ShortWay way = short_way_between(a, b);
  return std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
}

bool crosses(const ShortWay& a, const ShortWay& b) {
  if ((a.north_m > 0.0) == (b.north_m > 0.0)) return false;
  return a.east_m - a.north_m * (b.east_m - a.east_m) / (b.north_m - a.north_m) > 0.0;
}

}  // namespace

bool is_within(const scenario::Area& area, GeoPoint position) {
  if (area.has_centre()) {
    return metres_between(geo_point(area.centre()), position) <= area.radius_nm() * 1852.0;
  }
  bool inside = false;
  for (int i = 0; i < area.corners_size(); ++i) {
    const auto& next = area.corners((i + 1) % area.corners_size());
    if (crosses(short_way_between(position, geo_point(area.corners(i))),
                short_way_between(position, geo_point(next)))) {
      inside = !inside;
    }
  }
  return inside;
}

ExerciseEvents::ExerciseEvents(std::shared_ptr<const scenario::Scenario> scenario)
    : scenario_(std::move(scenario)),
      happened_(static_cast<std::size_t>(scenario_->events_size())) {}

std::optional<Duration> ExerciseEvents::happened(const std::string& name) const {
  for (std::size_t i = 0; i < happened_.size(); ++i) {
    if (scenario_->events(static_cast<int>(i)).name() == name) return happened_[i];
  }
  return std::nullopt;
}

const ShipState* ExerciseEvents::find(const std::string& name,
                                      const std::vector<ShipState>& own_ships,
                                      const std::vector<ShipState>& targets) const {
  for (const auto* ships : {&own_ships, &targets}) {
    for (const ShipState& ship : *ships) {
      if (ship.name == name) return &ship;
    }
  }
  return nullptr;
}

bool ExerciseEvents::holds(const scenario::Event& event, Duration now,
                           const std::vector<ShipState>& own_ships,
                           const std::vector<ShipState>& targets) const {
  if (event.has_at_min() && now < minutes_of(event.at_min())) return false;
  if (event.has_after()) {
    const auto before = happened(event.after());
    if (!before || now < *before + minutes_of(event.after_min())) return false;
  }
  if (event.has_collides() && !collided_.contains(event.collides())) return false;
  if (event.has_grounds() && !grounded_.contains(event.grounds())) return false;
  if (!event.has_ship()) return true;
  const ShipState* const ship = find(event.ship(), own_ships, targets);
  if (ship == nullptr) return false;
  if (event.has_within_of()) {
    const ShipState* const other = find(event.within_of(), own_ships, targets);
    if (other == nullptr) return false;
    if (metres_between(ship->position, other->position) > event.within_nm() * 1852.0) return false;
  }
  if (event.has_enters()) {
    for (const scenario::Area& area : scenario_->areas()) {
      if (area.name() == event.enters() && !is_within(area, ship->position)) return false;
    }
  }
  const double speed_kn = std::fabs(ship->speed_mps) / knots_in_mps(1.0);
  if (event.has_faster_than_kn() && speed_kn <= event.faster_than_kn()) return false;
  return !event.has_slower_than_kn() || speed_kn < event.slower_than_kn();
}

std::vector<const scenario::Event*> ExerciseEvents::look(Duration now,
                                                         const std::vector<ShipState>& own_ships,
                                                         const std::vector<ShipState>& targets) {
  std::vector<const scenario::Event*> happen;
  for (std::size_t i = 0; i < happened_.size(); ++i) {
    const scenario::Event& event = scenario_->events(static_cast<int>(i));
    if (happened_[i] || !holds(event, now, own_ships, targets)) continue;
    happened_[i] = now;
    happen.push_back(&event);
  }
  return happen;
}

}  // namespace skerry::server
