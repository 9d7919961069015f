// A route of the traffic: where, how fast, when, and what then.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <memory>
#include <optional>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/exercise.pb.h"

namespace skerry::server {

struct RouteStop {
  GeoPoint place;
  std::optional<double> speed_mps;  // on the leg to it; absent: as on the leg before
  std::optional<double> arrive_s;   // on the exercise's clock
  double stop_s = 0.0;
  // How long the leg to it takes by the timetable, where there is one: the same on every later run.
  std::optional<double> leg_s;
  wire::Waypoint told;
};

// Immutable once sailed.
struct Route {
  std::vector<RouteStop> stops;  // the first is where the route begins
  wire::RouteEnd end = wire::END_STOP;
  double speed_mps = 0.0;  // until a leg has one of its own
};
using RoutePtr = std::shared_ptr<const Route>;

// From `begin` at `begin_s` at `speed_mps`, over the waypoints.
RoutePtr route_of(GeoPoint begin, double begin_s, double speed_mps,
                  const google::protobuf::RepeatedPtrField<wire::Waypoint>& waypoints,
                  wire::RouteEnd end);

}  // namespace skerry::server
