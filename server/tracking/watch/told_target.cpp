#include "server/tracking/watch/told_target.hpp"

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {

wire::TargetState target_state(double tracked_s) {
  if (tracked_s < kTrendAfter_s) return wire::TARGET_ACQUIRING;
  return tracked_s < kTrackedAfter_s ? wire::TARGET_TREND : wire::TARGET_TRACKED;
}

double tracked_s(const PlottedTrack& track) { return in_seconds(track.time - track.first_seen); }

PlanePoint from_own_ship(const PlottedTrack& track) {
  return vector_of(track.bearing.in_degrees(), track.range_m);
}

void put_place(GeoPoint place, PlanePoint from_own_ship, wire::Target& target) {
  target.set_latitude_deg(place.latitude_deg);
  target.set_longitude_deg(place.longitude_deg);
  target.set_range_m(length_of(from_own_ship));
  target.set_bearing_deg(direction_of(from_own_ship));
}

void put_track(const PlottedTrack& track, wire::Target& target) {
  target.set_number(track.number);
  target.set_by_hand(track.by_hand);
  put_place(track.place, from_own_ship(track), target);
  target.set_tracked_s(tracked_s(track));
  target.set_hits(track.hits);
  target.set_looks(track.looks);
  target.set_place_sigma_m(track.place_sigma_m);
  target.set_speed_sigma_kn(track.velocity_sigma_mps / kKnot);
  target.set_length_m(track.length_m);
  target.set_width_m(track.width_m);
}

void put_motion(PlanePoint relative_mps, std::optional<PlanePoint> own_mps, wire::Target& target) {
  target.set_relative_course_deg(direction_of(relative_mps));
  target.set_relative_speed_kn(length_of(relative_mps) / kKnot);
  if (!own_mps) return;
  const PlanePoint mps = relative_mps + *own_mps;
  target.set_course_deg(direction_of(mps));
  target.set_speed_kn(length_of(mps) / kKnot);
}

void put_plot(const Plot& plot, wire::TargetPlot& told) {
  const GeoPoint place =
      echo::LocalPlane(plot.own_ship).to_geo(vector_of(plot.bearing.in_degrees(), plot.range_m));
  told.set_range_m(plot.range_m);
  told.set_bearing_deg(plot.bearing.in_degrees());
  told.set_latitude_deg(place.latitude_deg);
  told.set_longitude_deg(place.longitude_deg);
  told.set_length_m(plot.length_m);
  told.set_width_m(plot.width_m);
  told.set_level(plot.greatest);
  told.set_utc_ns(static_cast<std::uint64_t>(plot.utc.time_since_epoch().count()));
}

}  // namespace skerry::server
