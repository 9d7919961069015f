// Truth and tracks out of plane coordinates, a point each second.
#pragma once

#include <string>
#include <utility>

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server::made {

inline constexpr double kBegin_s = 1'700'000'000.0;

// Whose places are exact: an anchor where the scene's plane has its own.
inline const echo::LocalPlane& plane() {
  static const echo::LocalPlane the_plane(GeoPoint{60.0, 5.0});
  return the_plane;
}

inline std::vector<TruthPoint> still(double from_s, double until_s, PlanePoint at = {}) {
  std::vector<TruthPoint> points;
  for (double t = from_s; t <= until_s; t += 1.0)
    points.push_back({kBegin_s + t, plane().to_geo(at), 0.0, 0.0});
  return points;
}

// `place(t)`: where it is t seconds after kBegin_s.
template <typename Place>
TruthTarget target(std::string id, double from_s, double until_s, const Place& place) {
  TruthTarget out;
  out.id = std::move(id);
  for (double t = from_s; t <= until_s; t += 1.0)
    out.points.push_back({kBegin_s + t, plane().to_geo(place(t)), {}, {}});
  return out;
}

template <typename Place>
ToldTrack track(std::string number, double from_s, double until_s, const Place& place,
                ToldStatus status = ToldStatus::tracked) {
  ToldTrack out;
  out.number = std::move(number);
  for (double t = from_s; t <= until_s; t += 1.0) {
    ToldPoint point;
    point.utc_s = kBegin_s + t;
    point.status = status;
    point.place = plane().to_geo(place(t));
    out.points.push_back(point);
  }
  return out;
}

}  // namespace skerry::server::made
