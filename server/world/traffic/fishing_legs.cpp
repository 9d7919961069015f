#include "server/world/traffic/fishing_legs.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {

FishingLegs::FishingLegs(GeoPoint middle, double radius_m, std::uint64_t seed)
    : middle_(middle), radius_m_(radius_m), seed_(seed) {}

void FishingLegs::begin_leg(double to_middle_deg, bool at_edge, double now_s) {
  const auto chance = [&](std::uint64_t what) {
    return echo::as_unit(echo::mixed(seed_, leg_, what));
  };
  ++leg_;
  const double bend = chance(1) - 0.5;
  // From the edge towards the middle, 60 deg to either side; else anywhere.
  order_.course_deg = wrapped_degrees(to_middle_deg + (at_edge ? 120.0 : 360.0) * bend);
  order_.speed_mps = knots_in_mps(2.5 + 1.5 * chance(2));
  until_s_ = now_s + 60.0 * (5.0 + 15.0 * chance(3));
}

FishingOrder FishingLegs::steer(GeoPoint position, double now_s, double circle_m) {
  const ShortWay way = short_way_between(position, middle_);
  const double away_m = std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
  const bool at_edge = away_m > std::max(radius_m_ - circle_m, 0.5 * radius_m_);
  if (now_s >= until_s_ || (at_edge && !was_at_edge_)) {
    const double to_middle = echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian;
    begin_leg(to_middle, at_edge, now_s);
  }
  was_at_edge_ = at_edge;
  return order_;
}

}  // namespace skerry::server
