#include "server/world/traffic/traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/traffic/traffic_ship.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kTrafficStream = 0x74726166;  // apart from other uses of the seed

std::optional<Leader> leader_of(const scenario::Scenario& scenario, const std::string& name) {
  for (int i = 0; i < scenario.own_ships_size(); ++i) {
    if (scenario.own_ships(i).name() == name) return Leader{static_cast<std::size_t>(i), true};
  }
  for (int i = 0; i < scenario.targets_size(); ++i) {
    const scenario::Target& target = scenario.targets(i);
    if (target.kind() == scenario::Target::ship && target.name() == name) {
      return Leader{static_cast<std::size_t>(i), false};
    }
  }
  return std::nullopt;
}

SeenShip seen_own(const ShipState& ship, std::size_t number) {
  const echo::SinCos course = echo::sin_cos_degrees(ship.course_over_ground_deg);
  SeenShip seen;
  seen.number = number;
  seen.own = true;
  seen.position = ship.position;
  seen.way = {ship.speed_mps * course.sin, ship.speed_mps * course.cos};
  seen.course_deg = ship.course_over_ground_deg;
  seen.speed_mps = std::fabs(ship.speed_mps);
  seen.length_m = ship.length_m;
  return seen;
}

}  // namespace

struct Traffic::Ship {
  TrafficShip ship;
};

class Traffic::Kept {
 public:
  Kept(std::size_t number, Ship ship) : number_(number), ship_(std::move(ship)) {}

 private:
  friend class Traffic;
  std::size_t number_;
  Ship ship_;
};

Traffic::Traffic(const scenario::Scenario& scenario)
    : seed_(echo::mixed(scenario.seed(), kTrafficStream)) {
  const Environment environment = environment_of(scenario);
  for (int i = 0; i < scenario.targets_size(); ++i) {
    const scenario::Target& target = scenario.targets(i);
    if (target.kind() != scenario::Target::ship) continue;
    const auto number = static_cast<std::size_t>(i);
    const auto leader = target.has_follows() ? leader_of(scenario, target.follows()) : std::nullopt;
    ships_.emplace(
        number, std::make_shared<Ship>(Ship{TrafficShip(target, number, echo::mixed(seed_, number),
                                                        leader, Duration::zero(), environment)}));
  }
}

Traffic::~Traffic() = default;

Traffic::Traffic(const Traffic& other) : seed_(other.seed_), reached_(other.reached_) {
  for (const auto& [number, ship] : other.ships_) {
    ships_.emplace_hint(ships_.end(), number, std::make_shared<Ship>(*ship));
  }
}

Traffic& Traffic::operator=(const Traffic& other) {
  Traffic copy(other);
  std::swap(ships_, copy.ships_);
  seed_ = other.seed_;
  reached_ = other.reached_;
  return *this;
}

void Traffic::step(Duration now, Duration tick, const std::vector<ShipState>& own_ships,
                   const Environment& environment) {
  reached_ = now + tick;
  bool looks = false;
  for (auto& [number, each] : ships_) {
    each->ship.advance(tick);
    looks = looks || each->ship.looks(reached_, tick);
  }
  std::vector<ShipState> own_now = own_ships;
  for (ShipState& ship : own_now) {
    const ShipPlace place = position_at(ship, tick);
    ship.position = place.position;
    ship.heading_deg = place.heading_deg;
    ship.course_over_ground_deg = place.course_over_ground_deg;
  }
  std::vector<SeenShip> seen;
  if (looks) {
    seen.reserve(ships_.size() + own_now.size());
    for (std::size_t i = 0; i < own_now.size(); ++i) seen.push_back(seen_own(own_now[i], i));
    for (const auto& [number, each] : ships_) {
      if (each->ship.is_on_water(reached_)) seen.push_back(each->ship.seen(reached_));
    }
  }
  // Leaders as they are before anyone plans, so that the order of the list does not matter.
  std::map<std::size_t, ShipState> leaders;
  for (const auto& [number, each] : ships_) {
    const auto leader = each->ship.follows();
    if (!leader || leader->own) continue;
    const auto found = ships_.find(leader->number);
    if (found == ships_.end() || !found->second->ship.is_on_water(reached_)) continue;
    leaders.try_emplace(leader->number, found->second->ship.state(reached_, reached_));
  }
  for (auto& [number, each] : ships_) {
    const ShipState* leader = nullptr;
    if (const auto wanted = each->ship.follows()) {
      if (wanted->own) {
        if (wanted->number < own_now.size()) leader = &own_now[wanted->number];
      } else if (const auto found = leaders.find(wanted->number); found != leaders.end()) {
        leader = &found->second;
      }
    }
    each->ship.plan(reached_, tick, environment, seen, leader);
  }
}

std::vector<ShipState> Traffic::states(Duration now) const {
  std::vector<ShipState> states;
  states.reserve(ships_.size());
  for (const auto& [number, each] : ships_) {
    if (each->ship.is_on_water(now)) states.push_back(each->ship.state(now, reached_));
  }
  return states;
}

std::optional<ShipState> Traffic::state(std::size_t number, Duration now) const {
  const auto found = ships_.find(number);
  if (found == ships_.end() || !found->second->ship.is_on_water(now)) return std::nullopt;
  return found->second->ship.state(now, reached_);
}

std::optional<std::string> Traffic::fault_of(const wire::TargetChange& change) const {
  const auto found = ships_.find(change.target());
  if (found == ships_.end()) {
    return fmt::format("target: there is no ship {} among the targets", change.target());
  }
  return found->second->ship.fault_of(change, reached_);
}

void Traffic::order(const wire::TargetChange& change, Duration) {
  ships_.at(change.target())->ship.order(change, reached_);
}

void Traffic::add(const scenario::Target& target, std::size_t number, Duration) {
  // A new ship follows nobody and her berth is where she is put, so that no weather lays her.
  ships_[number] = std::make_shared<Ship>(Ship{TrafficShip(
      target, number, echo::mixed(seed_, number), std::nullopt, reached_, Environment{})});
}

void Traffic::tell(std::size_t number, Duration, wire::ExerciseShip& ship) const {
  ships_.at(number)->ship.tell(reached_, ship);
}

bool Traffic::has(std::size_t number) const { return ships_.contains(number); }

std::shared_ptr<const Traffic::Kept> Traffic::keep(std::size_t number) const {
  return std::make_shared<const Kept>(number, *ships_.at(number));
}

void Traffic::put_back(const Kept& kept) {
  ships_[kept.number_] = std::make_shared<Ship>(kept.ship_);
}

}  // namespace skerry::server
