#include "server/plotter/judge/baselines/told_book.hpp"

#include <utility>

#include "protocol/quantity/speed.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {

void ToldBook::tell(std::size_t number, double utc_s, ToldStatus status, PlanePoint place,
                    std::optional<PlanePoint> velocity_mps) {
  if (tracks_.size() >= kMostTracks && !tracks_.contains(number)) return;
  ToldTrack& track = tracks_[number];
  if (track.number.empty()) track.number = std::to_string(number);
  ToldPoint point;
  point.utc_s = utc_s;
  point.status = status;
  point.place = plane_.to_geo(place);
  if (velocity_mps) {
    point.course_deg = course_of(*velocity_mps);
    point.speed_kn = length_of(*velocity_mps) / kKnot;
  }
  track.points.push_back(point);
}

Told ToldBook::told(std::string name) {
  Told out;
  out.name = std::move(name);
  for (auto& [number, track] : tracks_) out.tracks.push_back(std::move(track));
  return out;
}

echo::LocalPlane plane_of(const std::vector<DetectionScan>& scans) {
  return echo::LocalPlane(scans.empty() ? GeoPoint{} : scans.front().own_ship);
}

std::vector<PlanePoint> places_of(const DetectionScan& scan, const echo::LocalPlane& plane) {
  const echo::LocalPlane about_own(scan.own_ship);
  std::vector<PlanePoint> out;
  out.reserve(scan.plots.size());
  for (const PlanePoint plot : scan.plots) out.push_back(plane.to_plane(about_own.to_geo(plot)));
  return out;
}

}  // namespace skerry::server
