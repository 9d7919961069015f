#include "server/world/world.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ratio>
#include <stdexcept>
#include <utility>

#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kTideHours = 12.4206;  // principal lunar semidiurnal, M2

}  // namespace

World::World(const scenario::Scenario& scenario)
    : scenario_(std::make_shared<const scenario::Scenario>(scenario)),
      environment_(std::make_shared<const Environment>(environment_of(scenario))) {
  for (const scenario::OwnShip& ship : scenario.own_ships()) {
    const auto seed = echo::mixed(scenario.seed(), own_ships_.size());
    own_ships_.emplace_back(ship, *environment_, kTick, seed);
  }
  for (int i = 0; i < scenario.targets_size(); ++i) {
    const scenario::Target& target = scenario.targets(i);
    const auto number = static_cast<std::size_t>(i);
    if (target.kind() == scenario::Target::ship) {
      RadarSetPtr radar;
      if (target.has_radar()) {
        radar = std::make_shared<const echo::RadarSet>(*shipped_set(target.radar()));
      }
      ships_.push_back({TargetTrack(target), number, std::move(radar)});
    } else if (target.speed_kn() > 0.0) {
      adrift_.push_back({TargetTrack(target), number, nullptr});
    }
    if (target.sart() && target.kind() != scenario::Target::ship) {
      sarts_.push_back({TargetTrack(target), target.height_m()});
    }
  }
  for (const scenario::Sart& sart : scenario.sarts()) {
    scenario::Target raft;
    *raft.mutable_position() = sart.position();
    raft.set_course_deg(sart.course_deg());
    raft.set_speed_kn(sart.speed_kn());
    sarts_.push_back({TargetTrack(raft), sart.height_m()});
  }
}

WorldState World::state() const {
  const Duration since_start = kTick * static_cast<std::int64_t>(tick_);
  WorldState state;
  state.time = ScenarioTime(since_start);
  state.own_ships.reserve(own_ships_.size());
  state.targets.reserve(ships_.size());
  for (const OwnShip& ship : own_ships_) {
    state.own_ships.push_back(ship.state());
    state.own_ships.back().number = state.own_ships.size() - 1;
  }
  for (const Track& ship : ships_) {
    state.targets.push_back(ship.way.at(since_start));
    state.targets.back().number = ship.number;
    state.targets.back().radar = ship.radar;
  }
  for (const Track& small : adrift_) {
    const ShipState at = small.way.at(since_start);
    state.adrift.push_back({small.number, at.position, at.course_over_ground_deg, at.speed_mps});
  }
  for (const Drift& sart : sarts_) {
    const ShipState at = sart.way.at(since_start);
    state.sarts.push_back({at.position, at.course_over_ground_deg, at.speed_mps, sart.height_m});
  }
  const scenario::Sea& sea = scenario_->sea();
  const double hours = std::chrono::duration<double, std::ratio<3600>>(since_start).count();
  const double phase = kRadiansPerTurn * (hours - sea.high_water_h()) / kTideHours;
  state.water_level_m = -0.5 * sea.tide_range_m() * (1.0 - std::cos(phase));
  state.environment = environment_;
  for (const RainCloud& cloud : environment_->rain) {
    state.rain.push_back({&cloud, place_of(cloud, state.time)});
  }
  state.scenario = scenario_;
  return state;
}

void World::set_environment(Environment environment) {
  environment_ = std::make_shared<const Environment>(std::move(environment));
}

void World::step() {
  for (OwnShip& ship : own_ships_) ship.step(*environment_);
  ++tick_;
}

namespace {

void require(const std::optional<double>& value, double least, double most, const char* name) {
  if (!value || (*value >= least && *value <= most)) return;
  throw std::invalid_argument(
      fmt::format("{}: {} is out of range; allowed: {} to {}", name, *value, least, most));
}

}  // namespace

bool World::drive(std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now) {
  if (own_ship >= own_ships_.size()) {
    throw std::invalid_argument(
        fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ships_.size()));
  }
  OwnShipFix whole = fix;
  if (fix.position) {
    require(fix.position->latitude_deg, -90.0, 90.0, "latitude");
    require(fix.position->longitude_deg, -180.0, 180.0, "longitude");
    whole.position->longitude_deg = wrapped_longitude(fix.position->longitude_deg);
  }
  require(fix.heading_deg, 0.0, 360.0, "heading");
  require(fix.course_over_ground_deg, 0.0, 360.0, "course over ground");
  require(fix.speed_mps, 0.0, kMaxDrivenSpeed_mps, "speed (m/s)");
  require(fix.rate_of_turn_deg_min, -kMaxDrivenTurn_deg_min, kMaxDrivenTurn_deg_min,
          "rate of turn (deg/min)");
  return own_ships_[own_ship].drive(whole, now.time_since_epoch());
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

std::optional<std::string> World::fault_of(std::size_t own_ship,
                                           const wire::ConOrder& order) const {
  if (own_ship >= own_ships_.size()) {
    return fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ships_.size());
  }
  return own_ships_[own_ship].fault_of(order);
}

void World::order(std::size_t own_ship, const wire::ConOrder& order) {
  if (const auto fault = fault_of(own_ship, order)) throw std::invalid_argument(*fault);
  own_ships_[own_ship].order(order);
}

}  // namespace skerry::server
