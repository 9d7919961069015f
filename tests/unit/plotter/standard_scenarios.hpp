// The four scenarios by which plotting aids are tested, with the errors of their sensors.
//
// IMO A.823(19), appendix 2, and 33 CFR 164.38, appendix; what they ask for is a row of the table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "server/plotter/tracks/tracker.hpp"
#include "tests/unit/plotter/made_plots.hpp"

namespace skerry::server {

// Errors, 95 of 100 runs are within them; 0: not asked for.
struct ScenarioErrors {
  double relative_course_deg = 0.0, relative_speed_kn = 0.0, cpa_nm = 0.0, tcpa_min = 0.0;
  double true_course_deg = 0.0, true_speed_kn = 0.0;

  std::array<double, 6> all() const {
    return {relative_course_deg, relative_speed_kn, cpa_nm, tcpa_min,
            true_course_deg,     true_speed_kn};
  }
};

struct StandardScenario {
  double own_speed_kn;           // course 000
  double range_nm, bearing_deg;  // at the end
  double relative_course_deg, relative_speed_kn;
  double true_course_deg, true_speed_kn;
  double cpa_nm, tcpa_min;
  ScenarioErrors after_1_min, after_3_min;
};

inline const std::array<StandardScenario, 4> kStandardScenarios{{
    {10, 8, 0, 180, 20, 180.0, 10.0, 0, 24, {11, 2.8, 1.6}, {3.0, .8, .5, 1.0, 7.4, 1.2}},
    {10, 1, 0, 90, 10, 45.0, 14.142, 1, 0, {7, .6}, {2.3, .3, 0, 0, 2.8, .8}},
    {5, 8, 45, 225, 20, 237.12, 16.840, 0, 24, {14, 2.2, 1.8}, {4.4, .9, .7, 1.0, 3.3, 1.0}},
    {25, 8, 45, 225, 20, 307.52, 17.830, 0, 24, {15, 1.5, 2.0}, {4.6, .8, .7, 1.0, 2.6, 1.2}},
}};

// MSC.192(79), table 3: the same for all targets, but a share of the speed where that is more.
inline ScenarioErrors msc192_after_1_min(const StandardScenario& scenario) {
  return {11, std::max(1.5, 0.1 * scenario.relative_speed_kn), 1.0};
}
inline ScenarioErrors msc192_after_3_min(const StandardScenario& scenario) {
  return {3, std::max(.8, .01 * scenario.relative_speed_kn), .3, .5,
          5, std::max(.5, .01 * scenario.true_speed_kn)};
}

// Of the track at the end, in the order of ScenarioErrors::all().
inline std::vector<double> errors_of(const StandardScenario& scenario, const PlottedTrack& track) {
  const auto course = [](PlanePoint v) {
    return std::atan2(v.east_m, v.north_m) * kDegreesPerRadian;
  };
  const auto knots = [](PlanePoint v) { return length_of(v) * 3600.0 / 1852.0; };
  const auto off = [](double a, double b) { return std::fabs(std::remainder(a - b, 360.0)); };
  const PlottedApproach cpa = closest_approach(track);
  const PlanePoint relative = track.relative_velocity_mps;
  return {off(course(relative), scenario.relative_course_deg),
          std::fabs(knots(relative) - scenario.relative_speed_kn),
          std::fabs(cpa.range_m / 1852.0 - scenario.cpa_nm),
          std::fabs(cpa.time_s / 60.0 - scenario.tcpa_min),
          off(course(track.velocity_mps), scenario.true_course_deg),
          std::fabs(knots(track.velocity_mps) - scenario.true_speed_kn)};
}

// One run of a scenario: from `minutes` before its end, with errors of this seed.  The errors are
// those of the track at the end; true ones with own ship's course and speed by gyro and log.
class StandardRun {
 public:
  StandardRun(const StandardScenario& scenario, double minutes, std::uint64_t seed)
      : scenario_(scenario), seconds_(60.0 * minutes), state_(seed * 977 + 5) {
    constant_deg_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
    constant_kn_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
    roll_phase_ = 2.0 * kPi * next_share(state_);
  }

  // Empty if there is no track of it.
  std::vector<double> errors(const Tracker::Rule& rule = {.acquire = Tracker::Acquire::all}) {
    Tracker tracker(rule);
    run(tracker);
    const auto tracks = tracker.tracks();
    if (tracks.empty()) return {};
    return errors_of(scenario_, tracks.front());
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;
  static constexpr double kTurn_s = 2.5, kRoll_s = 12.0;
  static constexpr int kPasses = 72;

  double draw() { return next_draw(state_); }
  double uniform(double most) { return most * (2.0 * next_share(state_) - 1.0); }
  static PlanePoint way(double course_deg, double speed_kn) {
    const double a = course_deg / kDegreesPerRadian, v = speed_kn * 1852.0 / 3600.0;
    return {v * std::sin(a), v * std::cos(a)};
  }

  // What the antenna measures of an echo that lies `off` of own ship.
  PlanePoint measured(PlanePoint off, double t, double gyro_deg) {
    const double h = scenario_.true_course_deg / kDegreesPerRadian;
    const double along = 30.0 * draw(), across = draw();
    off = off + PlanePoint{along * std::sin(h) + across * std::cos(h),
                           along * std::cos(h) - across * std::sin(h)};
    double deg = std::atan2(off.east_m, off.north_m) * kDegreesPerRadian;
    // Own ship heads north, so this is the relative bearing, too: none ahead, most at 045.
    const double roll = 0.22 + 0.22 * std::sin(4.0 * kPi * t / kRoll_s + roll_phase_);
    deg += roll * std::sin(2.0 * deg / kDegreesPerRadian);
    deg += 0.05 * draw() + uniform(0.05) + uniform(0.1) + 0.03 * draw() + gyro_deg;
    const double range_m = length_of(off) + 20.0 * draw() + uniform(0.01 * 1852.0);
    return {range_m, deg};
  }

  void run(Tracker& tracker) {
    const MadeSea earth;
    const PlanePoint own = way(0.0, scenario_.own_speed_kn);
    const PlanePoint target = way(scenario_.true_course_deg, scenario_.true_speed_kn);
    const PlanePoint end = way(scenario_.bearing_deg, scenario_.range_nm * 3600.0);
    PlanePoint reckoned;  // own ship's place by gyro and log
    const double step_s = kTurn_s / kPasses;
    double log_kn = 0.0, gyro_deg = 0.0;
    // It is seen first at the begin, and last at the end: the antenna points at it then.
    const long first = std::lround(-seconds_ / step_s) - kPasses / 2;
    double before_deg = 1e9;
    for (long n = first; n <= kPasses / 3; ++n) {
      const double t = static_cast<double>(n) * step_s;
      const double antenna_deg = std::fmod(
          scenario_.bearing_deg + static_cast<double>(n) * 360.0 / kPasses + 36'000'000.0, 360.0);
      if ((n - first) % 6 == 0) {  // five times a second or so
        log_kn = constant_kn_ + draw() * 0.2 / 3.0;
        gyro_deg = constant_deg_ + 0.12 * draw();
      }
      own_told_ = way(gyro_deg, scenario_.own_speed_kn + log_kn);
      reckoned = reckoned + own_told_ * step_s;
      const PlanePoint off = end + (target - own) * t;
      const double deg = std::atan2(off.east_m, off.north_m) * kDegreesPerRadian;
      const auto time = ScenarioTime(
          std::chrono::duration_cast<Duration>(std::chrono::duration<double>(t + 1000.0)));
      const double from = std::remainder(deg - before_deg, 360.0);
      const double to = std::remainder(deg - antenna_deg, 360.0);
      if (before_deg < 1e8 && from > 0.0 && to <= 0.0 && from - to < 90.0) {
        const PlanePoint polar = measured(off, t, gyro_deg);
        Plot plot;
        plot.time = time;
        plot.own_ship = earth.geo(reckoned);
        plot.range_m = polar.east_m;
        plot.bearing = TrueBearing::from(degrees(polar.north_m));
        plot.range_sigma_m = 24.0;
        plot.bearing_sigma_rad = 0.1 / kDegreesPerRadian;
        // What the extractor would see of a hull of 200 m: all of it along the range, and across
        // what is wider than a beam of 1.2 deg.
        const double aspect =
            scenario_.true_course_deg / kDegreesPerRadian - deg / kDegreesPerRadian;
        plot.length_m = 200.0 * std::fabs(std::cos(aspect));
        plot.width_m = std::max(
            200.0 * std::fabs(std::sin(aspect)) - 1.2 / kDegreesPerRadian * plot.range_m, 0.0);
        plot.greatest = 200;
        plot.cells = 20;
        tracker.add(plot);
      }
      before_deg = antenna_deg;
      tracker.pass({.time = time,
                    .own_ship = earth.geo(reckoned),
                    .bearing = TrueBearing::from(degrees(antenna_deg)),
                    .reach_m = 24.0 * 1852.0,
                    .width_rad = 2.0 * kPi / kPasses});
    }
  }

  StandardScenario scenario_;
  double seconds_;
  std::uint64_t state_;
  double constant_deg_ = 0.5, constant_kn_ = 0.5, roll_phase_ = 0.0;
  PlanePoint own_told_;
};

// The error that 95 of 100 runs are within, of each kind; `lost` counts runs without a track.
// `run(i)` gives the errors of run i, or nothing.
template <typename Run>
std::vector<double> errors_of_95(int runs, int& lost, const Run& run) {
  std::vector<std::vector<double>> kinds(6);
  lost = 0;
  for (int i = 0; i < runs; ++i) {
    const std::vector<double> errors = run(i);
    if (errors.empty()) ++lost;
    for (std::size_t k = 0; k < errors.size(); ++k) kinds[k].push_back(errors[k]);
  }
  std::vector<double> most;
  for (auto& kind : kinds) {
    std::sort(kind.begin(), kind.end());
    most.push_back(
        kind.empty()
            ? 1e9
            : kind[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(kind.size()))) -
                   1]);
  }
  return most;
}

inline std::vector<double> errors_of_95(const StandardScenario& scenario, double minutes, int runs,
                                        int& lost, const Tracker::Rule& rule) {
  return errors_of_95(runs, lost, [&](int i) {
    return StandardRun(scenario, minutes, static_cast<std::uint64_t>(i)).errors(rule);
  });
}

}  // namespace skerry::server
