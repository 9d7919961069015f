#include "server/plotter/judge/own_tracker.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr int kPasses = 72;
constexpr double kPass_deg = 360.0 / kPasses;
constexpr double kPlotSigma_m = 1.0;

ScenarioTime time_of(double utc_s, double first_s) {
  return ScenarioTime(
      std::chrono::duration_cast<Duration>(std::chrono::duration<double>(utc_s - first_s)));
}

double compass_deg(PlanePoint v) {
  double deg = echo::exact_atan2(v.east_m, v.north_m) * kDegreesPerRadian;
  if (deg < 0.0) deg += 360.0;
  return deg < 360.0 ? deg : 0.0;
}

ToldPoint told_point(const PlottedTrack& track, double utc_s) {
  ToldPoint point;
  point.utc_s = utc_s;
  point.status = track.status == TrackStatus::lost ? ToldStatus::lost : ToldStatus::tracked;
  point.place = track.place;
  point.course_deg = compass_deg(track.velocity_mps);
  point.speed_kn = length_of(track.velocity_mps) / kKnot;
  return point;
}

}  // namespace

Told skerry_tracks(const std::vector<DetectionScan>& scans, const Tracker::Rule& rule) {
  Tracker tracker(rule);
  std::map<std::uint32_t, ToldTrack> tracks;
  for (const DetectionScan& scan : scans) {
    const ScenarioTime time = time_of(scan.utc_s, scans.front().utc_s);
    for (int pass = 1; pass <= kPasses; ++pass) {
      const double end_deg = pass * kPass_deg;
      for (const PlanePoint& off : scan.plots) {
        const double deg = compass_deg(off);
        if (deg < end_deg - kPass_deg || deg >= end_deg) continue;
        Plot plot;
        plot.time = time;
        plot.own_ship = scan.own_ship;
        plot.bearing = TrueBearing::from(degrees(deg));
        plot.range_m = length_of(off);
        plot.range_sigma_m = kPlotSigma_m;
        tracker.add(plot);
      }
      tracker.pass({.time = time,
                    .utc = {},
                    .own_ship = scan.own_ship,
                    .bearing = TrueBearing::from(degrees(end_deg)),
                    .reach_m = 1e5,
                    .width_rad = kPass_deg / kDegreesPerRadian});
    }
    for (const PlottedTrack& track : tracker.tracks()) {
      tracks[track.number].points.push_back(told_point(track, scan.utc_s));
    }
    for (const PlottedTrack& track : tracker.take_lost()) {
      tracks[track.number].points.push_back(told_point(track, scan.utc_s));
    }
  }
  Told told{"skerry", {}};
  for (auto& [number, track] : tracks) {
    track.number = std::to_string(number);
    told.tracks.push_back(std::move(track));
  }
  return told;
}

}  // namespace skerry::server
