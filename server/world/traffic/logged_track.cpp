#include "server/world/traffic/logged_track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kAhead_s = 0.1;  // over which speed and course are taken: a tick

struct LegMotion {
  double speed_mps = 0.0, course_deg = 0.0;
};

LegMotion leg_motion(GeoPoint here, GeoPoint ahead) {
  const ShortWay way = short_way_between(here, ahead);
  const double length_m = std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
  return {length_m / kAhead_s,
          wrapped_degrees(echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian)};
}

}  // namespace

LoggedTrack::LoggedTrack(const scenario::Target& target) {
  fixes_.push_back({60.0 * target.start_min(), geo_point(target.position()), 0.0});
  for (const wire::Waypoint& waypoint : target.waypoints()) {
    fixes_.push_back({60.0 * waypoint.arrive_min(), geo_point(waypoint), 0.0});
  }
  // Legs without way before the first with way take its heading, unless the target has one.
  std::optional<double> heading_deg;
  if (target.course_deg() != 0.0) heading_deg = wrapped_degrees(target.course_deg());
  std::size_t waiting = 0;
  for (std::size_t leg = 0; leg + 1 < fixes_.size(); ++leg) {
    Fix& from = fixes_[leg];
    const LegMotion motion =
        leg_motion(from.place, place_on(from, fixes_[leg + 1], from.at_s + kAhead_s));
    if (motion.speed_mps >= kSteers_mps) heading_deg = motion.course_deg;
    if (!heading_deg) continue;
    for (; waiting <= leg; ++waiting) fixes_[waiting].heading_deg = *heading_deg;
  }
  fixes_.back().heading_deg = heading_deg.value_or(0.0);
}

bool LoggedTrack::covers(Duration exercise) const {
  const double at_s = in_seconds(exercise);
  return at_s >= fixes_.front().at_s && at_s < fixes_.back().at_s;
}

GeoPoint LoggedTrack::place_on(const Fix& from, const Fix& to, double at_s) {
  const double share = (at_s - from.at_s) / (to.at_s - from.at_s);
  const double east =
      std::remainder(to.place.longitude_deg - from.place.longitude_deg, 360.0) * share;
  const double north = (to.place.latitude_deg - from.place.latitude_deg) * share;
  return {from.place.latitude_deg + north, wrapped_longitude(from.place.longitude_deg + east)};
}

std::size_t LoggedTrack::leg_at(double at_s) const {
  const auto next = std::upper_bound(fixes_.begin() + 1, fixes_.end() - 1, at_s,
                                     [](double at, const Fix& fix) { return at < fix.at_s; });
  return static_cast<std::size_t>(next - fixes_.begin()) - 1;
}

void LoggedTrack::put(Duration exercise, ShipState& ship) const {
  const double at_s = in_seconds(exercise);
  const std::size_t leg = leg_at(at_s);
  const Fix& from = fixes_[leg];
  const Fix& to = fixes_[leg + 1];
  ship.position = place_on(from, to, std::clamp(at_s, from.at_s, to.at_s));
  LegMotion motion;
  if (covers(exercise)) motion = leg_motion(ship.position, place_on(from, to, at_s + kAhead_s));
  ship.speed_mps = ship.ordered_speed_mps = motion.speed_mps;
  ship.heading_deg = motion.speed_mps >= kSteers_mps ? motion.course_deg : from.heading_deg;
  ship.course_over_ground_deg = motion.speed_mps > 0.0 ? motion.course_deg : ship.heading_deg;
  ship.ordered_course_deg = ship.heading_deg;
  ship.rate_of_turn_deg_s = 0.0;
}

std::size_t LoggedTrack::passed_at(Duration exercise) const {
  const double at_s = in_seconds(exercise);
  return static_cast<std::size_t>(std::count_if(fixes_.begin() + 1, fixes_.end(),
                                                [&](const Fix& fix) { return at_s >= fix.at_s; }));
}

}  // namespace skerry::server
