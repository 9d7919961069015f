#include "server/world/target_track.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>

#include "protocol/quantity/angle.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {

TargetTrack::TargetTrack(const scenario::Target& target) {
  start_.name = target.name();
  start_.position = geo_point(target.position());
  start_.heading_deg = wrapped_degrees(target.course_deg());
  start_.speed_mps = knots_in_mps(target.speed_kn());
  start_.ordered_speed_mps = start_.speed_mps;
  start_.length_m = target.length_m();
  start_.beam_m = target.beam_m();
  start_.height_m = target.height_m();
  start_.cross_section_m2 = target.cross_section_m2();
  start_.wake = target.wake();
  start_.sart = target.sart();
  start_.mmsi = target.mmsi();

  GeoPoint from = start_.position;
  double way_m = 0.0;
  for (const wire::Waypoint& waypoint : target.waypoints()) {
    const GeoPoint to = geo_point(waypoint);
    const auto line = GeographicLib::Geodesic::WGS84().InverseLine(
        from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg);
    legs_.push_back({way_m, line.Distance(), line});
    way_m += line.Distance();
    from = to;
  }
}

ShipState TargetTrack::at(Duration since_start) const {
  ShipState ship = start_;
  const double way_m = start_.speed_mps * std::max(in_seconds(since_start), 0.0);
  if (!legs_.empty()) {
    sail_legs(way_m, ship);
  } else {
    const RhumbEnd end = advanced(start_.position, start_.heading_deg, way_m);
    ship.position = end.position;
    if (end.over_pole) ship.heading_deg = wrapped_degrees(start_.heading_deg + 180.0);
  }
  ship.course_over_ground_deg = ship.heading_deg;
  ship.ordered_course_deg = ship.heading_deg;
  return ship;
}

std::size_t TargetTrack::passed_at(Duration since_start) const {
  const double way_m = start_.speed_mps * std::max(in_seconds(since_start), 0.0);
  return static_cast<std::size_t>(
      std::count_if(legs_.begin(), legs_.end(),
                    [way_m](const Leg& leg) { return way_m >= leg.start_m + leg.length_m; }));
}

void TargetTrack::sail_legs(double way_m, ShipState& ship) const {
  const auto next = std::upper_bound(legs_.begin() + 1, legs_.end(), way_m,
                                     [](double way, const Leg& leg) { return way < leg.start_m; });
  const Leg& leg = *(next - 1);
  double latitude = 0.0, longitude = 0.0, azimuth = 0.0;
  leg.line.Position(std::min(way_m - leg.start_m, leg.length_m), latitude, longitude, azimuth);
  ship.position = {latitude, wrapped_longitude(longitude)};
  ship.heading_deg = wrapped_degrees(azimuth);
  const Leg& last = legs_.back();
  if (way_m >= last.start_m + last.length_m) ship.speed_mps = ship.ordered_speed_mps = 0.0;
}

}  // namespace skerry::server
