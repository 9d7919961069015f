#include "server/world/traffic/route_pilot.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

constexpr double kOntoTrack_deg = 5.0;   // a turn is done
constexpr double kIntercept_deg = 40.0;  // steepest, back to the line
constexpr double kSpeedMoved = 0.02;     // of it: then the wheel-over is worked out anew
constexpr double kThere_m = 0.5;
constexpr double kStopsAt_m = 0.02;
constexpr double kSlowest_mps = 0.05;

double length_of_way(ShortWay way) {
  return std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
}

double course_of_way(ShortWay way) {
  return wrapped_degrees(echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian);
}

}  // namespace

RoutePilot::RoutePilot(RoutePtr route, double now_s, double along_m) : route_(std::move(route)) {
  leg_speed_mps_ = route_->speed_mps;
  place_ = route_->stops.front().place;
  left_s_ = now_s;
  begin_leg(place_);
  while (!over_ && along_m > 0.0) {
    const ShortWay way = short_way_between(from_, to().place);
    const double length_m = length_of_way(way);
    if (along_m < length_m) {
      const double share = along_m / length_m;
      place_ = advanced(from_, ShortWay{share * way.north_m, share * way.east_m});
      break;
    }
    along_m -= length_m;
    place_ = to().place;
    if (is_end()) break;
    go_on(now_s);
  }
  turns_ = false;
}

double RoutePilot::course_deg() const {
  return course_of_way(short_way_between(from_, to().place));
}

std::optional<std::size_t> RoutePilot::after(std::size_t stop, int direction) const {
  const std::size_t last = route_->stops.size() - 1;
  if (direction > 0 && stop < last) return stop + 1;
  if (direction < 0 && stop > 0) return stop - 1;
  if (route_->end == wire::END_BACK) return direction > 0 ? last - 1 : 1;
  if (route_->end == wire::END_ROUND && last > 1) return 1;
  return std::nullopt;
}

void RoutePilot::begin_leg(GeoPoint from) {
  from_ = from;
  turns_ = true;
  wheel_over_mps_ = -1.0;
  turn_deg_ = 0.0;
  const RouteStop& stop = to();
  // Sailed back, a leg's speed and time are those of the stop that it comes from.
  const RouteStop& leg = direction_ > 0 ? stop : route_->stops[to_ + 1];
  if (leg.speed_mps) leg_speed_mps_ = *leg.speed_mps;
  due_s_.reset();
  if (leg.leg_s && left_s_) due_s_ = *left_s_ + *leg.leg_s;
  const auto next = after(to_, direction_);
  if (!next) return;
  const double here = course_of_way(short_way_between(from, stop.place));
  const double there = course_of_way(short_way_between(stop.place, route_->stops[*next].place));
  turn_deg_ = std::remainder(there - here, 360.0);
}

void RoutePilot::go_on(double now_s) {
  const auto next = after(to_, direction_);
  if (!next) {
    over_ = true;
    return;
  }
  left_s_ = due_s_ ? *due_s_ + to().stop_s : now_s;
  const GeoPoint from = to().place;
  const bool begins_anew = route_->end == wire::END_ROUND && *next <= to_;
  if (route_->end == wire::END_BACK) direction_ = *next > to_ ? 1 : -1;
  to_ = *next;
  begin_leg(from);
  if (begins_anew) due_s_.reset();  // the timetable does not know this leg
}

void RoutePilot::leave_from(GeoPoint position) {
  const auto left = left_s_, due = due_s_;
  begin_leg(position);
  left_s_ = left;
  due_s_ = due;
  lies_until_s_.reset();
}

void RoutePilot::end_with(wire::RouteEnd end) {
  auto route = std::make_shared<Route>(*route_);
  route->end = end;
  route_ = std::move(route);
  if (direction_ < 0 && end != wire::END_BACK)
    direction_ = 1;  // on from the stop that she makes for
  if (over_ && after(to_, direction_)) over_ = false;
  wheel_over_mps_ = -1.0;
}

double RoutePilot::speed_for(double left_m, double now_s, const ShipAnswer& answer) {
  if (!due_s_) return std::min(leg_speed_mps_, answer.most_mps);
  const double left_s = *due_s_ - now_s;
  double wanted = answer.most_mps;
  if (lies_there()) {
    // left = v (t - v / b) + v^2 / 2b, b her braking.
    const double b = answer.braking();
    const double rest = left_s * left_s - 2.0 * left_m / b;
    if (left_s > 0.0 && rest >= 0.0) wanted = b * (left_s - std::sqrt(rest));
  } else if (left_s > 0.0) {
    wanted = left_m / left_s;
  }
  leg_speed_mps_ = std::clamp(wanted, kSlowest_mps, answer.most_mps);
  return leg_speed_mps_;
}

RouteOrder RoutePilot::steer(GeoPoint position, double heading_deg, double speed_mps, double now_s,
                             const ShipAnswer& answer) {
  RouteOrder order;
  if (over_) {
    order.course_deg = order.leg_deg = heading_deg;
    order.brake_mps2 = answer.braking();
    return order;
  }
  if (lies_until_s_) {
    const auto next = after(to_, direction_);
    order.brake_mps2 = answer.braking();
    order.course_deg =
        next ? course_of_way(short_way_between(to().place, route_->stops[*next].place))
             : heading_deg;
    order.leg_deg = order.course_deg;
    if (now_s < *lies_until_s_) return order;
    lies_until_s_.reset();
    go_on(now_s);
    from_ = position;  // she lies near the waypoint, not on it
    order.brake_mps2 = 0.0;
    if (over_) return order;
  }
  for (std::size_t passed = 0;; ++passed) {
    const ShortWay way = short_way_between(position, to().place);
    const ShortWay back = short_way_between(position, from_);
    const ShortWay leg{way.north_m - back.north_m, way.east_m - back.east_m};
    const double leg_m = length_of_way(leg);
    double left_m = length_of_way(way), off_m = 0.0;
    order.leg_deg = course_of_way(way);
    if (leg_m > 1.0 && leg_m < kLongTrack_m) {
      left_m = (way.north_m * leg.north_m + way.east_m * leg.east_m) / leg_m;
      // To starboard of the line.
      off_m = (way.north_m * leg.east_m - way.east_m * leg.north_m) / leg_m;
      order.leg_deg = course_of_way(leg);
    }
    if (lies_there()) {
      if (left_m <= kStopsAt_m) {
        const double due = due_s_.value_or(now_s);
        lies_until_s_ = std::max(now_s, due + to().stop_s);
        if (is_end() && route_->end == wire::END_STOP) over_ = true;
        order.course_deg = heading_deg;
        order.brake_mps2 = std::max(answer.braking(), speed_mps * speed_mps / (2.0 * kStopsAt_m));
        return order;
      }
      // v^2 / 2s takes her to rest just there.
      const double brake = speed_mps * speed_mps / (2.0 * left_m);
      if (brake >= answer.braking() && speed_mps > kSlowest_mps) order.brake_mps2 = brake;
      order.speed_mps = std::max(speed_for(left_m, now_s, answer), kSlowest_mps);
      if (speed_mps <= kSlowest_mps && left_m < 20.0) order.speed_mps = kSlowest_mps;
    } else {
      if (is_end()) {
        if (left_m <= kThere_m) {
          if (route_->end == wire::END_AGAIN) {
            to_ = 1;
            direction_ = 1;
            leg_speed_mps_ = route_->speed_mps;
            left_s_ = now_s;
            place_ = route_->stops.front().place;
            begin_leg(place_);
            turns_ = false;
            order.put = place_;
            order.course_deg = order.leg_deg = course_deg();
            order.speed_mps = std::min(leg_speed_mps_, answer.most_mps);
          } else {
            over_ = true;
            order.vanishes = route_->end == wire::END_VANISH;
            order.course_deg = heading_deg;
            order.brake_mps2 = answer.braking();
          }
          return order;
        }
      } else {
        if (std::fabs(speed_mps - wheel_over_mps_) > kSpeedMoved * std::fabs(wheel_over_mps_)) {
          wheel_over_mps_ = speed_mps;
          // Not so early that she would cut off half of a short leg.
          wheel_over_m_ = std::min(server::wheel_over_m(answer, speed_mps, turn_deg_),
                                   std::max(0.5 * leg_m, kThere_m));
        }
        if (left_m <= std::max(wheel_over_m_, kThere_m) && passed < route_->stops.size()) {
          go_on(now_s);
          continue;
        }
      }
      // By the round of the turn, of which half belongs to this leg, it is less far.
      const double half = 0.5 * std::min(std::fabs(turn_deg_), 120.0) * kRadiansPerDegree;
      const echo::SinCos corner = echo::sin_cos_degrees(half * kDegreesPerRadian);
      const double round_m =
          half < 1e-3 ? wheel_over_m_ : wheel_over_m_ * half * corner.cos / corner.sin;
      order.speed_mps = speed_for(left_m - wheel_over_m_ + round_m, now_s, answer);
    }
    const double left_to_turn = std::remainder(order.leg_deg - heading_deg, 360.0);
    if (std::fabs(left_to_turn) < kOntoTrack_deg) turns_ = false;
    order.course_deg = order.leg_deg;
    if (!turns_) {
      // Twelve lags ahead of her on the line: slow enough for her to follow.
      const double ahead_m = std::max(12.0 * answer.turn_s * std::fabs(speed_mps), 50.0);
      const double bend = echo::exact_atan2(off_m, ahead_m) * kDegreesPerRadian;
      order.course_deg =
          wrapped_degrees(order.leg_deg - std::clamp(bend, -kIntercept_deg, kIntercept_deg));
    }
    return order;
  }
}

std::vector<wire::Waypoint> RoutePilot::left() const {
  std::vector<wire::Waypoint> left;
  if (over_) return left;
  int direction = direction_;
  for (std::size_t stop = to_; left.size() < route_->stops.size();) {
    left.push_back(route_->stops[stop].told);
    if (direction > 0 ? stop + 1 == route_->stops.size() : stop == 0) break;
    stop = direction > 0 ? stop + 1 : stop - 1;
  }
  return left;
}

}  // namespace skerry::server
