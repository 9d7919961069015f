#include "server/world/world.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ratio>
#include <stdexcept>
#include <utility>

#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

std::vector<OwnShip> own_ships_of(const scenario::Scenario& scenario,
                                  const Environment& environment) {
  std::vector<OwnShip> ships;
  for (const scenario::OwnShip& ship : scenario.own_ships()) {
    ships.emplace_back(ship, environment, World::kTick, echo::mixed(scenario.seed(), ships.size()));
  }
  return ships;
}

}  // namespace

World::World(const scenario::Scenario& scenario)
    : part_([&] {
        auto shared = std::make_shared<const scenario::Scenario>(scenario);
        auto environment = std::make_shared<const Environment>(environment_of(scenario));
        return Part{.clock = {},
                    .steps = 0,
                    .scenario = shared,
                    .own_ships = own_ships_of(scenario, *environment),
                    .traffic = Traffic(scenario),
                    .environment = environment,
                    .events = ExerciseEvents(shared),
                    .contacts = {}};
      }()),
      scripted_targets_(static_cast<std::size_t>(scenario.targets_size())) {
  for (int i = 0; i < scenario.targets_size(); ++i) {
    const scenario::Target& target = scenario.targets(i);
    if (target.kind() == scenario::Target::ship) continue;
    const auto number = static_cast<std::size_t>(i);
    if (target.speed_kn() > 0.0) adrift_.push_back({TargetTrack(target), number, 0.0});
    if (target.sart()) sarts_.push_back({TargetTrack(target), number, target.height_m()});
  }
  for (const scenario::Sart& sart : scenario.sarts()) {
    scenario::Target raft;
    *raft.mutable_position() = sart.position();
    raft.set_course_deg(sart.course_deg());
    raft.set_speed_kn(sart.speed_kn());
    sarts_.push_back({TargetTrack(raft), 0, sart.height_m()});
  }
  auto log = std::make_shared<ExerciseLog>();
  log->texts.resize(part_.own_ships.size());
  log_ = std::move(log);
}

ShipState World::own_ship_at(std::size_t number) const {
  ShipState ship = part_.own_ships[number].state();
  ship.number = number;
  const Duration into = since_step();
  if (into > Duration::zero()) {
    const ShipPlace place = position_at(ship, into);
    ship.position = place.position;
    ship.heading_deg = place.heading_deg;
    ship.course_over_ground_deg = place.course_over_ground_deg;
  }
  return ship;
}

WorldState World::state() const {
  const Duration now = part_.clock.now;
  const double pace = part_.clock.pace();
  WorldState state;
  state.time = ScenarioTime(kTick * static_cast<std::int64_t>(tick_));
  state.exercise = now;
  state.pace = pace;
  state.frozen = part_.clock.frozen;
  state.rate = part_.clock.rate();
  state.log = log_;
  state.own_ships.reserve(part_.own_ships.size());
  for (std::size_t i = 0; i < part_.own_ships.size(); ++i) {
    state.own_ships.push_back(own_ship_at(i));
    state.own_ships.back().pace = pace;
  }
  state.targets = part_.traffic.states(now);
  for (ShipState& ship : state.targets) ship.pace = pace;
  for (const Drift& small : adrift_) {
    const ShipState at = small.way.at(now);
    state.adrift.push_back(
        {small.number, at.position, at.course_over_ground_deg, at.speed_mps, pace});
  }
  for (const Drift& sart : sarts_) {
    const ShipState at = sart.way.at(now);
    state.sarts.push_back(
        {at.position, at.course_over_ground_deg, at.speed_mps, sart.height_m, pace});
  }
  state.water_level_m = part_.environment->waters->tide().over_coastline_m(now);
  state.environment = part_.environment;
  for (const RainCloud& cloud : part_.environment->rain) {
    state.rain.push_back({&cloud, place_of(cloud, now)});
  }
  state.scenario = part_.scenario;
  state.scripted_targets = scripted_targets_;
  return state;
}

std::size_t World::ticks_ahead() const {
  const ExerciseClock& clock = part_.clock;
  return clock.frozen ? 0 : static_cast<std::size_t>((clock.rate_tenths + 9) / 10);
}

void World::step() {
  part_.clock.advance(kTick);
  // Begun steps are whole: a ship's motion holds until the next.
  while (kTick * (part_.steps + 1) <= part_.clock.now) step_exercise();
  ++tick_;
}

void World::step_exercise() {
  const Duration now = kTick * part_.steps;
  std::vector<ShipState> own_ships;
  for (OwnShip& ship : part_.own_ships) own_ships.push_back(ship.state());
  part_.traffic.step(now, kTick, own_ships, *part_.environment);
  for (OwnShip& ship : part_.own_ships) ship.step(*part_.environment);
  ++part_.steps;
  const Duration then = kTick * part_.steps;
  look_for_mishaps(then);
  if (part_.events.is_empty() || then % ExerciseEvents::kLook != Duration::zero()) return;
  for (std::size_t i = 0; i < own_ships.size(); ++i) own_ships[i] = part_.own_ships[i].state();
  const auto events = part_.events.look(then, own_ships, part_.traffic.states(then));
  for (const scenario::Event* event : events) happen(*event);
}

namespace {

void require(const std::optional<double>& value, double least, double most, const char* name) {
  if (!value || (*value >= least && *value <= most)) return;
  throw std::invalid_argument(
      fmt::format("{}: {} is out of range; allowed: {} to {}", name, *value, least, most));
}

}  // namespace

bool World::drive(std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now) {
  if (own_ship >= part_.own_ships.size()) {
    throw std::invalid_argument(
        fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ship_count()));
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
  const Duration into =
      now.time_since_epoch() - kTick * static_cast<std::int64_t>(tick_);  // of this tick
  const bool begins = part_.own_ships[own_ship].drive(whole, part_.clock.at(into));
  if (begins) part_.contacts.search_anew();
  return begins;
}

void World::order(std::size_t own_ship, std::optional<double> course_deg,
                  std::optional<double> speed_kn) {
  if (own_ship >= part_.own_ships.size()) {
    throw std::invalid_argument(
        fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ship_count()));
  }
  if (course_deg && !std::isfinite(*course_deg)) {
    throw std::invalid_argument("course: not a number of degrees");
  }
  if (speed_kn && !(*speed_kn >= kMinSpeedKn && *speed_kn <= kMaxSpeedKn)) {
    throw std::invalid_argument(fmt::format("speed: {} kn is out of range; allowed: {} to {} kn",
                                            *speed_kn, kMinSpeedKn, kMaxSpeedKn));
  }
  if (course_deg) part_.own_ships[own_ship].order_course(*course_deg);
  if (speed_kn) part_.own_ships[own_ship].order_speed(knots_in_mps(*speed_kn));
  part_.contacts.search_anew();
}

std::optional<std::string> World::fault_of(std::size_t own_ship,
                                           const wire::ConOrder& order) const {
  if (own_ship >= part_.own_ships.size()) {
    return fmt::format("own ship {}: there are {}, counted from 0", own_ship, own_ship_count());
  }
  return part_.own_ships[own_ship].fault_of(order);
}

void World::order(std::size_t own_ship, const wire::ConOrder& order) {
  if (const auto fault = fault_of(own_ship, order)) throw std::invalid_argument(*fault);
  part_.own_ships[own_ship].order(order);
  part_.contacts.search_anew();
}

}  // namespace skerry::server
