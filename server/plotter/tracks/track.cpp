#include "server/plotter/tracks/track.hpp"

#include <cmath>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {

PlottedApproach closest_approach(const PlottedTrack& track) {
  const echo::SinCos direction = echo::sin_cos_degrees(track.bearing.in_degrees());
  return closest_approach(PlanePoint{direction.sin, direction.cos} * track.range_m,
                          track.relative_velocity_mps);
}

PlottedApproach closest_approach(PlanePoint from, PlanePoint way) {
  constexpr double kStill_mps = 0.05;
  if (dot(way, way) < kStill_mps * kStill_mps) return {length_of(from), 0.0, false};
  const double time_s = -dot(from, way) / dot(way, way);
  return {length_of(from + way * time_s), time_s, true};
}

}  // namespace skerry::server
