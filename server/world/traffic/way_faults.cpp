#include "server/world/traffic/way_faults.hpp"

#include <fmt/format.h>

#include "server/world/route_checks.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kSpeedRounding = 1e-9;  // of a speed

}  // namespace

std::optional<std::string> fault_of_speed(const std::string& who, double speed_kn,
                                          double most_mps) {
  const double most_kn = most_mps / knots_in_mps(1.0);
  if (speed_kn <= most_kn * (1.0 + kSpeedRounding)) return std::nullopt;
  return fmt::format("speed: {} kn for {} is more than she can do; allowed: up to {:.1f} kn",
                     speed_kn, who, most_kn);
}

std::optional<std::string> fault_of_way(
    const std::string& who, GeoPoint from,
    const google::protobuf::RepeatedPtrField<wire::Waypoint>& route, double most_mps) {
  if (route.size() > kMaxWaypoints) {
    return fmt::format("route: {} waypoints; allowed: at most {}", route.size(), kMaxWaypoints);
  }
  double last_min = -1.0;
  for (int i = 0; i < route.size(); ++i) {
    const wire::Waypoint& waypoint = route[i];
    const GeoPoint to = geo_point(waypoint);
    if (!is_leg(distance_between(from, to))) {
      return fmt::format("route: the leg to waypoint {} is {:.3f} NM long; allowed: 1 m to 5000 NM",
                         i + 1, distance_between(from, to).in_nautical_miles());
    }
    if (waypoint.has_speed_kn()) {
      if (auto fault = fault_of_speed(who, waypoint.speed_kn(), most_mps)) return fault;
    }
    if (waypoint.has_arrive_min()) {
      if (waypoint.arrive_min() <= last_min) {
        return fmt::format(
            "route: waypoint {} is to be reached at {} min; allowed: later than the "
            "one before, at {} min",
            i + 1, waypoint.arrive_min(), last_min);
      }
      last_min = waypoint.arrive_min();
    }
    from = to;
  }
  return std::nullopt;
}

}  // namespace skerry::server
