#include "server/exercise_tool/closest_approach.hpp"

#include <algorithm>
#include <cmath>

#include "server/world/short_way.hpp"

namespace skerry::server {
double metres_apart(const ShipState& a, const ShipState& b) {
  const ShortWay way = short_way_between(a.position, b.position);
  return std::hypot(way.north_m, way.east_m);
}

void ClosestApproaches::look(const WorldState& state) {
  for (std::size_t i = 0; i < state.own_ships.size(); ++i) {
    for (std::size_t k = i + 1; k < state.own_ships.size(); ++k) {
      look(state.own_ships[i], state.own_ships[k], state.exercise);
    }
    for (const ShipState& target : state.targets) look(state.own_ships[i], target, state.exercise);
  }
}

void ClosestApproaches::look(const ShipState& own, const ShipState& other, Duration now) {
  const double apart_m = metres_apart(own, other);
  const auto [found, is_new] = approaches_.emplace(
      std::pair(own.name, other.name), ClosestApproach{own.name, other.name, apart_m, now});
  ClosestApproach& approach = found->second;
  if (apart_m < approach.closest_m) {
    approach.closest_m = apart_m;
    approach.when = now;
  }
}

std::vector<ClosestApproach> ClosestApproaches::nearest() const {
  std::vector<ClosestApproach> all;
  for (const auto& [names, approach] : approaches_) all.push_back(approach);
  std::stable_sort(all.begin(), all.end(), [](const ClosestApproach& a, const ClosestApproach& b) {
    return a.closest_m < b.closest_m;
  });
  return all;
}

}  // namespace skerry::server
