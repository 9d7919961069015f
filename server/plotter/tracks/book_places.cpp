// Where plots, targets and own ship are in the plane.
#include "server/plotter/tracks/book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {

void Tracker::Book::begin(const AntennaPass& antenna) {
  for (const Followed& followed : followed_) {
    if (followed.number != 0) tell_lost(followed);
  }
  followed_.clear();
  open_.clear();
  extended_.clear();
  false_plots_ = {};
  suspects_ = {};
  lost_targets_.forget();
  shown_ = 0;
  plane_.emplace(antenna.own_ship);
  own_motion_.start(plane_->to_plane(antenna.own_ship), antenna.time);
  stepped_deg_ = antenna.bearing.in_degrees();
  stepped_ = antenna.time;
  gap_ = true;
}

void Tracker::Book::lay_plane_anew(GeoPoint anchor) {
  const GroundPlane before = *plane_;
  plane_.emplace(anchor);
  const auto moved = [&](PlanePoint place) { return plane_->to_plane(before.to_geo(place)); };
  // The new plane's north is turned against the old one's by as much as the meridians converge.
  const double turn_deg = before.true_less_plane_degrees(anchor);
  const echo::SinCos turn = echo::sin_cos_degrees(turn_deg);
  MotionMatrix turning = MotionMatrix::Identity();
  for (const int at : {0, 2}) {
    turning(at, at) = turning(at + 1, at + 1) = turn.cos;
    turning(at, at + 1) = turn.sin;
    turning(at + 1, at) = -turn.sin;
  }
  const auto change = [&](MotionState& state) {
    const PlanePoint place = moved(state.place());
    state.mean = turning * state.mean;
    state.mean(0) = place.east_m;
    state.mean(1) = place.north_m;
    state.covariance = turning * state.covariance * turning.transpose();
  };
  for (Followed& followed : followed_) {
    followed.target.change(change);
    followed.target.move_first_place(moved(followed.target.first_place()));
  }
  lost_targets_.change(change);
  own_motion_.change(change);
  for (Extended& each : extended_) each.place = moved(each.place);
  for (Open& open : open_) open.placed = place(open.placed.plot);
}

PlacedPlot Tracker::Book::place(const Plot& plot) const {
  const PlanePoint own = plane_->to_plane(plot.own_ship);
  const double plane_deg =
      plot.bearing.in_degrees() - plane_->true_less_plane_degrees(plot.own_ship);
  const echo::SinCos along = echo::sin_cos_degrees(plane_deg);
  PlacedPlot placed;
  placed.plot = plot;
  placed.measured.place = {own.east_m + plot.range_m * along.sin,
                           own.north_m + plot.range_m * along.cos};
  const double floor_rad = rule_.bearing_sigma_deg / kDegreesPerRadian;
  // A hull glints along itself: a twelfth of what is seen of it is the variance of anywhere on it.
  const double range2 = 1.0 + plot.range_sigma_m * plot.range_sigma_m +
                        rule_.range_sigma_m * rule_.range_sigma_m +
                        plot.length_m * plot.length_m / 48.0;
  const double across2 = (plot.bearing_sigma_rad * plot.bearing_sigma_rad + floor_rad * floor_rad) *
                             plot.range_m * plot.range_m +
                         1.0 + rule_.range_sigma_m * rule_.range_sigma_m / 4.0 +
                         plot.width_m * plot.width_m / 48.0;
  PlaceMatrix& r = placed.measured.covariance;
  r(0, 0) = range2 * along.sin * along.sin + across2 * along.cos * along.cos;
  r(1, 1) = range2 * along.cos * along.cos + across2 * along.sin * along.sin;
  r(0, 1) = r(1, 0) = (range2 - across2) * along.sin * along.cos;
  return placed;
}

// Degrees in the plane.
double Tracker::Book::bearing_of(PlanePoint from_own) const {
  const double degrees = echo::exact_atan2(from_own.east_m, from_own.north_m) * kDegreesPerRadian;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

double Tracker::Book::off_deg(PlanePoint place) const {
  return wrapped_deg(antenna_.bearing.in_degrees() + north_deg_ - bearing_of(place - own_place_));
}

}  // namespace skerry::server
