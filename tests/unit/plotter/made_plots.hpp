// Plots of targets whose ways are known, as a turning antenna would find them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "server/plotter/tracks/tracker.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {

// In metres east and north of `origin`, at t seconds; small distances, so the sphere will do.
using Way = std::function<PlanePoint(double)>;

inline Way straight_way(PlanePoint from, double course_deg, double speed_kn) {
  const double mps = speed_kn * 1852.0 / 3600.0, course = course_deg / kDegreesPerRadian;
  const PlanePoint v{mps * std::sin(course), mps * std::cos(course)};
  return [=](double t) { return from + v * t; };
}

struct MadeTarget {
  Way way;
  double seen = 1.0;  // probability of a plot in a turn
  double glint_along_m = 0.0, glint_across_m = 0.0, heading_deg = 0.0;
  std::function<void(Plot&)> also = [](Plot&) {};  // what else its plots say
};

struct MadeSea {
  GeoPoint origin{50.0, 3.0};
  Way own = [](double) { return PlanePoint{}; };
  std::vector<MadeTarget> targets;
  double rpm = 24.0;
  double range_sigma_m = 10.0, bearing_sigma_deg = 0.2;
  // So many false plots a turn, over the circle of `reach_m`.
  double false_a_turn = 0.0, reach_m = 12'000.0;
  std::function<double(double)> bearing_error_deg = [](double) { return 0.0; };
  std::uint64_t seed = 1;

  GeoPoint geo(PlanePoint p) const {
    const double lat = origin.latitude_deg + p.north_m / 111'229.0;  // of a meridian, at 50 N
    return {lat, origin.longitude_deg +
                     p.east_m / (111'413.0 * std::cos(lat / kDegreesPerRadian) * 1.00098)};
  }
};

// Uniform in [0, 1): splitmix64.
inline double next_share(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// Runs the tracker from `from_s` to `to_s`; calls `turn(t)` after each turn of the antenna.
inline void sail(const MadeSea& sea, Tracker& tracker, double from_s, double to_s,
                 const std::function<void(double)>& turn = {}) {
  constexpr int kPasses = 360;
  const double turn_s = 60.0 / sea.rpm;
  std::uint64_t state = sea.seed * 0x9E3779B97F4A7C15u + 77;
  const auto draw = [&] { return next_draw(state); };
  const auto share = [&] { return next_share(state); };
  std::vector<bool> due(sea.targets.size(), true);
  const auto time_of = [](double t) {
    return ScenarioTime(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(t)));
  };
  double before_deg = 0.0;
  for (long n = static_cast<long>(from_s / turn_s * kPasses);; ++n) {
    const double t = static_cast<double>(n) * turn_s / kPasses;
    if (t >= to_s) break;
    const double antenna_deg = static_cast<double>(n % kPasses) * 360.0 / kPasses;
    const PlanePoint own = sea.own(t);
    const auto tell = [&](PlanePoint off, const std::function<void(Plot&)>& also) {
      Plot plot;
      plot.time = time_of(t);
      plot.utc = UtcTime(plot.time.time_since_epoch());
      plot.own_ship = sea.geo(own);
      plot.range_m = length_of(off) + sea.range_sigma_m * draw();
      double deg = std::atan2(off.east_m, off.north_m) * kDegreesPerRadian;
      deg += sea.bearing_sigma_deg * draw() + sea.bearing_error_deg(t);
      plot.bearing = TrueBearing::from(degrees(deg));
      plot.range_sigma_m = sea.range_sigma_m;
      plot.bearing_sigma_rad = sea.bearing_sigma_deg / kDegreesPerRadian;
      plot.greatest = 200;
      plot.cells = 20;
      also(plot);
      tracker.add(plot);
    };
    for (const MadeTarget& target : sea.targets) {
      PlanePoint off = target.way(t) - own;
      const double deg = std::atan2(off.east_m, off.north_m) * kDegreesPerRadian;
      const double from = std::remainder(deg - before_deg, 360.0);
      const double to = std::remainder(deg - antenna_deg, 360.0);
      if (!(from > 0.0 && to <= 0.0 && from - to < 90.0) || share() > target.seen) continue;
      const double along = target.glint_along_m * draw(), across = target.glint_across_m * draw();
      const double h = target.heading_deg / kDegreesPerRadian;
      off = off + PlanePoint{along * std::sin(h) + across * std::cos(h),
                             along * std::cos(h) - across * std::sin(h)};
      tell(off, target.also);
    }
    if (share() < sea.false_a_turn / kPasses) {
      const double r = sea.reach_m * std::sqrt(share()), a = antenna_deg / kDegreesPerRadian;
      tell({r * std::sin(a), r * std::cos(a)}, [](Plot&) {});
    }
    tracker.pass({.time = time_of(t),
                  .utc = UtcTime(time_of(t).time_since_epoch()),
                  .own_ship = sea.geo(own),
                  .bearing = TrueBearing::from(degrees(antenna_deg)),
                  .reach_m = sea.reach_m,
                  .width_rad = 1.0 / kDegreesPerRadian});
    before_deg = antenna_deg;
    if (turn && n % kPasses == kPasses - 1) turn(t);
  }
}

}  // namespace skerry::server
