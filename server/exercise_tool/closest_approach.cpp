#include "server/exercise_tool/closest_approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

PlanePoint ahead_of(const ShipState& ship) {
  const double heading = degrees(ship.heading_deg).in_radians();
  return {std::sin(heading), std::cos(heading)};
}

// Half of what the outline covers along an axis of length 1.
double half_extent(const ShipState& ship, PlanePoint axis) {
  const PlanePoint ahead = ahead_of(ship);
  return 0.5 * (ship.length_m * std::fabs(dot(ahead, axis)) +
                ship.beam_m * std::fabs(cross(ahead, axis)));
}

}  // namespace

double metres_apart(const ShipState& a, const ShipState& b) {
  const ShortWay way = short_way_between(a.position, b.position);
  return std::hypot(way.north_m, way.east_m);
}

// Two rectangles are apart if and only if they are so along an axis of one of them.
bool outlines_touch(const ShipState& a, const ShipState& b) {
  const ShortWay way = short_way_between(a.position, b.position);
  const PlanePoint between{way.east_m, way.north_m};
  for (const PlanePoint ahead : {ahead_of(a), ahead_of(b)}) {
    for (const PlanePoint axis : {ahead, PlanePoint{ahead.north_m, -ahead.east_m}}) {
      if (std::fabs(dot(between, axis)) > half_extent(a, axis) + half_extent(b, axis)) return false;
    }
  }
  return true;
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
      std::pair(own.name, other.name), ClosestApproach{own.name, other.name, apart_m, now, false});
  ClosestApproach& approach = found->second;
  if (apart_m < approach.closest_m) {
    approach.closest_m = apart_m;
    approach.when = now;
  }
  if (apart_m < own.length_m + other.length_m) {
    approach.touched = approach.touched || outlines_touch(own, other);
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
