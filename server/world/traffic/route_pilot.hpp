// RoutePilot: sails a route, and says from tick to tick what course and speed that takes.
#pragma once

#include <cstddef>
#include <optional>

#include "server/world/short_way.hpp"
#include "server/world/traffic/route.hpp"
#include "server/world/traffic/ship_answer.hpp"

namespace skerry::server {

// What the route wants of her now.
struct RouteOrder {
  double course_deg = 0.0;  // to steer
  double leg_deg = 0.0;     // of her leg
  double speed_mps = 0.0;
  double brake_mps2 = 0.0;           // as Wanted
  std::optional<GeoPoint> put = {};  // she is put there, on `course_deg` at `speed_mps`
  bool vanishes = false;
};

// Legs are rhumb lines.  She keeps to the line by steering towards it, and turns ahead of a
// waypoint so that she comes out on the next.  A leg longer than kLongTrack_m has no line: she
// steers for its end.
// A leg with a time has the speed that what is left of way and time asks for, at every moment anew,
// at most her greatest.
// A copy is a snapshot.  Thread: one at a time.
class RoutePilot {
 public:
  static constexpr double kLongTrack_m = 185'200.0;

  // Her route begins where she is; `along_m` of it she has sailed already: then place() is where.
  RoutePilot(RoutePtr route, double now_s, double along_m = 0.0);

  // Of a ship that has sailed a part of it already.
  GeoPoint place() const { return place_; }
  double course_deg() const;  // of the leg that she is on
  double speed_mps() const { return leg_speed_mps_; }

  RouteOrder steer(GeoPoint position, double heading_deg, double speed_mps, double now_s,
                   const ShipAnswer& answer);
  // She makes for the same waypoint from another place.
  void leave_from(GeoPoint position);
  // Another end of the same route.
  void end_with(wire::RouteEnd end);

  // What is left, next first: of a route that has no end, up to that.
  std::vector<wire::Waypoint> left() const;
  const Route& route() const { return *route_; }

 private:
  const RouteStop& to() const { return route_->stops[to_]; }
  std::optional<std::size_t> after(std::size_t stop, int direction) const;
  bool is_end() const { return !after(to_, direction_); }
  bool lies_there() const {
    return to().stop_s > 0.0 || (is_end() && route_->end == wire::END_STOP);
  }
  void begin_leg(GeoPoint from);
  void go_on(double now_s);
  double speed_for(double left_m, double now_s, const ShipAnswer& answer);

  RoutePtr route_;
  std::size_t to_ = 1;
  int direction_ = 1;      // -1: back towards the begin
  GeoPoint from_, place_;  // of the leg
  double turn_deg_ = 0.0;  // at its end
  double wheel_over_m_ = 0.0, wheel_over_mps_ = -1.0;
  double leg_speed_mps_ = 0.0;
  bool turns_ = false;  // onto the leg
  bool over_ = false;
  std::optional<double> lies_until_s_;
  std::optional<double> left_s_;  // by the timetable, the stop before
  std::optional<double> due_s_;   // by the timetable, at the end of the leg
};

}  // namespace skerry::server
