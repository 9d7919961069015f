#include "server/world/traffic/route.hpp"

#include <algorithm>
#include <cmath>

#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {

RoutePtr route_of(GeoPoint begin, double begin_s, double speed_mps,
                  const google::protobuf::RepeatedPtrField<wire::Waypoint>& waypoints,
                  wire::RouteEnd end) {
  auto route = std::make_shared<Route>();
  route->end = end;
  route->speed_mps = speed_mps;
  RouteStop first;
  first.place = begin;
  first.told.set_lat(begin.latitude_deg);
  first.told.set_lon(begin.longitude_deg);
  route->stops.push_back(first);
  double leaves_s = begin_s;
  for (const wire::Waypoint& waypoint : waypoints) {
    RouteStop stop;
    stop.place = geo_point(waypoint);
    stop.told = waypoint;
    if (waypoint.has_speed_kn()) stop.speed_mps = speed_mps = knots_in_mps(waypoint.speed_kn());
    stop.stop_s = 60.0 * waypoint.stop_min();
    const ShortWay way = short_way_between(route->stops.back().place, stop.place);
    const double length_m = std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
    if (waypoint.has_arrive_min()) {
      stop.arrive_s = 60.0 * waypoint.arrive_min();
      stop.leg_s = std::max(*stop.arrive_s - leaves_s, 1.0);
      speed_mps = length_m / *stop.leg_s;
      leaves_s = *stop.arrive_s + stop.stop_s;
    } else {
      leaves_s += length_m / std::max(speed_mps, 0.05) + stop.stop_s;
    }
    route->stops.push_back(std::move(stop));
  }
  // A ferry lies as long where she began as at the other end.
  if (end == wire::END_BACK) route->stops.front().stop_s = route->stops.back().stop_s;
  return route;
}

}  // namespace skerry::server
