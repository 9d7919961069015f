#include "server/world/world.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <ratio>
#include <stdexcept>

#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kTideHours = 12.4206;  // principal lunar semidiurnal, M2

}  // namespace

World::World(const scenario::Scenario& scenario) : sea_(scenario.sea()) {
  for (const scenario::OwnShip& ship : scenario.own_ships()) own_ships_.emplace_back(ship, kTick);
  for (const scenario::TargetShip& target : scenario.targets()) targets_.emplace_back(target);
}

WorldState World::state() const {
  const Duration since_start = kTick * static_cast<std::int64_t>(tick_);
  WorldState state;
  state.time = ScenarioTime(since_start);
  state.own_ships.reserve(own_ships_.size());
  state.targets.reserve(targets_.size());
  for (const OwnShip& ship : own_ships_) state.own_ships.push_back(ship.state());
  for (const TargetTrack& target : targets_) state.targets.push_back(target.at(since_start));
  const double hours = std::chrono::duration<double, std::ratio<3600>>(since_start).count();
  const double phase = 2.0 * std::numbers::pi * (hours - sea_.high_water_h()) / kTideHours;
  state.water_level_m = -0.5 * sea_.tide_range_m() * (1.0 - std::cos(phase));
  state.wave_height_m = sea_.wave_height_m();
  return state;
}

void World::step() {
  for (OwnShip& ship : own_ships_) ship.step();
  ++tick_;
}

void World::order(std::size_t own_ship, std::optional<double> course_deg,
                  std::optional<double> speed_kn) {
  if (own_ship >= own_ships_.size()) {
    throw std::invalid_argument(
        fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ships_.size()));
  }
  if (course_deg && !std::isfinite(*course_deg)) {
    throw std::invalid_argument("course: not a number of degrees");
  }
  if (speed_kn && !(*speed_kn >= kMinSpeedKn && *speed_kn <= kMaxSpeedKn)) {
    throw std::invalid_argument(fmt::format("speed: {} kn is out of range; allowed: {} to {} kn",
                                            *speed_kn, kMinSpeedKn, kMaxSpeedKn));
  }
  if (course_deg) own_ships_[own_ship].order_course(*course_deg);
  if (speed_kn) own_ships_[own_ship].order_speed(knots_in_mps(*speed_kn));
}

}  // namespace skerry::server
