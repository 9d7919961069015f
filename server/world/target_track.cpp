#include "server/world/target_track.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>

#include "server/world/motion.hpp"

namespace skerry::server {

TargetTrack::TargetTrack(const scenario::TargetShip& target)
    : start_{target.position().lat(), wrapped_longitude(target.position().lon())},
      course_deg_(wrapped_course(target.course_deg())),
      speed_mps_(target.speed_kn() * kMetresPerSecondPerKnot) {
  if (target.waypoints_size() == 0) {
    length_m_ = rhumb_length_m(start_, course_deg_);
    return;
  }
  GeoPoint from = start_;
  for (const scenario::Position& waypoint : target.waypoints()) {
    const GeographicLib::GeodesicLine line = GeographicLib::Geodesic::WGS84().InverseLine(
        from.latitude_deg, from.longitude_deg, waypoint.lat(), waypoint.lon());
    from = {waypoint.lat(), waypoint.lon()};
    if (line.Distance() <= 0.0) continue;  // already there
    legs_.push_back({line, length_m_, length_m_ + line.Distance()});
    length_m_ = legs_.back().end_m;
  }
}

double TargetTrack::run_m(ScenarioTime t) const {
  return speed_mps_ * in_seconds(std::max(t.time_since_epoch(), Duration::zero()));
}

TargetTrack::Point TargetTrack::at(ScenarioTime t) const {
  const double run = std::min(run_m(t), length_m_);
  if (legs_.empty()) return {rhumb_destination(start_, course_deg_, run), course_deg_};
  // The first leg that ends beyond, so that at a waypoint the ship heads for the next one.
  auto leg = std::upper_bound(legs_.begin(), legs_.end(), run,
                              [](double sailed, const Leg& each) { return sailed < each.end_m; });
  if (leg == legs_.end()) --leg;
  double latitude = 0.0, longitude = 0.0, azimuth = 0.0;
  leg->line.Position(run - leg->start_m, latitude, longitude, azimuth);
  return {{latitude, wrapped_longitude(longitude)}, wrapped_course(azimuth)};
}

double TargetTrack::mean_speed_mps(ScenarioTime t, Duration dt) const {
  if (run_m(t + dt) <= length_m_) return speed_mps_;
  return std::max(length_m_ - run_m(t), 0.0) / in_seconds(dt);
}

}  // namespace skerry::server
