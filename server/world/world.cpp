#include "server/world/world.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace skerry::server {

World::World(const scenario::Scenario& scenario) {
  own_ships_.reserve(static_cast<std::size_t>(scenario.own_ships_size()));
  for (const scenario::OwnShip& ship : scenario.own_ships()) own_ships_.emplace_back(ship, kTick);
  targets_.reserve(static_cast<std::size_t>(scenario.targets_size()));
  for (const scenario::TargetShip& target : scenario.targets()) {
    ShipState state;
    state.name = target.name();
    state.length_m = target.length_m();
    state.beam_m = target.beam_m();
    state.height_m = target.height_m();
    targets_.push_back({TargetTrack(target), std::move(state)});
  }
}

WorldState World::state() const {
  WorldState world;
  world.time = time();
  world.own_ships.reserve(own_ships_.size());
  for (const OwnShip& ship : own_ships_) world.own_ships.push_back(ship.state());
  world.targets.reserve(targets_.size());
  for (const Target& target : targets_) {
    ShipState& state = world.targets.emplace_back(target.state);
    const TargetTrack::Point point = target.track.at(world.time);
    state.position = point.position;
    state.heading_deg = point.heading_deg;
    state.course_over_ground_deg = point.heading_deg;
    state.ordered_course_deg = point.heading_deg;
    state.speed_mps = target.track.mean_speed_mps(world.time, kTick);
    state.ordered_speed_mps = state.speed_mps;
  }
  return world;
}

void World::step() {
  for (OwnShip& ship : own_ships_) ship.step();
  ++ticks_;
}

void World::leap(std::int64_t ticks) {
  if (ticks <= 0) return;
  for (OwnShip& ship : own_ships_) ship.leap(ticks);
  ticks_ += ticks;
}

void World::order(std::size_t own_ship, std::optional<double> course_deg,
                  std::optional<double> speed_mps) {
  if (own_ship >= own_ships_.size()) {
    throw std::out_of_range(fmt::format("own ship {}: there are {}", own_ship, own_ships_.size()));
  }
  own_ships_[own_ship].order(course_deg, speed_mps);
}

}  // namespace skerry::server
