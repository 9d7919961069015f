#include "server/world/traffic/station.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kSteerageWay_mps = 0.4;  // with less she does not turn to where she drifts
constexpr double kQuickest_s = 60.0;      // time constant of what is missing

}  // namespace

StationOrder keep_station(const Station& station, const ShipState& leader, const ShipState& ship,
                          const ShipAnswer& answer) {
  const echo::SinCos bearing = echo::sin_cos_degrees(leader.heading_deg + station.bearing_deg);
  const ShortWay to_leader = short_way_between(ship.position, leader.position);
  const double north_m = to_leader.north_m + station.distance_m * bearing.cos;
  const double east_m = to_leader.east_m + station.distance_m * bearing.sin;
  const double slow = std::max({kQuickest_s, 16.0 * answer.turn_s, 3.0 * answer.speed_s});
  const echo::SinCos course = echo::sin_cos_degrees(leader.course_over_ground_deg);
  const double north = leader.speed_mps * course.cos + north_m / slow;
  const double east = leader.speed_mps * course.sin + east_m / slow;
  const double speed = std::sqrt(north * north + east * east);
  if (speed < kSteerageWay_mps) return {ship.heading_deg, 0.0};
  StationOrder order;
  order.course_deg = wrapped_degrees(echo::exact_atan2(east, north) * kDegreesPerRadian);
  // Of the way wanted, what lies ahead of her: she does not race off on a course yet to be left.
  const echo::SinCos off = echo::sin_cos_degrees(order.course_deg - ship.heading_deg);
  order.speed_mps = std::min(answer.most_mps, speed * std::max(0.0, off.cos));
  return order;
}

}  // namespace skerry::server
