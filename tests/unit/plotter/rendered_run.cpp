#include "tests/unit/plotter/rendered_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "echo/chart/local_plane.hpp"
#include "echo/spoke_renderer.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

constexpr double kRoll_s = 12.0, kRoll_deg = 10.0;
constexpr double kSector_deg = 15.0;  // on either side of the target
constexpr double kNear_m = 600.0;     // a plot of hers is no farther off
constexpr double kNearTrack_m = 1000.0;
constexpr GeoPoint kBegin{56.3, 4.2};

PlanePoint motion_of(double course_deg, double speed_kn) {
  const double a = course_deg / kDegreesPerRadian, v = speed_kn * 1852.0 / 3600.0;
  return {v * std::sin(a), v * std::cos(a)};
}

PlanePoint place_at(double bearing_deg, double range_m) {
  return motion_of(bearing_deg, range_m * 3600.0 / 1852.0);
}

double degrees_of(PlanePoint off) {
  return std::atan2(off.east_m, off.north_m) * kDegreesPerRadian;
}

// What gyro, log and antenna tell wrongly.
class FaultySensors {
 public:
  FaultySensors(double own_speed_kn, std::uint64_t seed, bool errors)
      : own_speed_kn_(own_speed_kn), errors_(errors), state_(seed * 977 + 5) {
    if (!errors_) return;
    constant_deg_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
    constant_kn_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
  }
  void draw_compass() {
    if (!errors_) return;
    gyro_deg_ = constant_deg_ + 0.12 * next_draw(state_);
    log_kn_ = constant_kn_ + 0.2 / 3.0 * next_draw(state_);
  }
  void draw_antenna() {
    if (errors_) antenna_deg_ = 0.05 * (2.0 * next_share(state_) - 1.0) + 0.03 * next_draw(state_);
  }
  // By how much a bearing told is more than the true one.
  double bearing_error_deg() const { return gyro_deg_ + antenna_deg_; }
  // Own ship's motion as gyro and log have it.
  PlanePoint velocity() const { return motion_of(gyro_deg_, own_speed_kn_ + log_kn_); }

 private:
  double own_speed_kn_;
  bool errors_;
  std::uint64_t state_;
  double constant_deg_ = 0.0, constant_kn_ = 0.0;
  double gyro_deg_ = 0.0, log_kn_ = 0.0, antenna_deg_ = 0.0;
};

// Places by time, and the straight line through them.
class PlotLine {
 public:
  void add(double t, PlanePoint at) {
    ++n_;
    sum_t_ += t;
    sum_tt_ += t * t;
    sum_ = sum_ + at;
    sum_t_at_ = sum_t_at_ + at * t;
  }
  int count() const { return n_; }
  PlanePoint velocity() const {
    return (sum_t_at_ - sum_ * (sum_t_ / n_)) * (1.0 / (sum_tt_ - sum_t_ * sum_t_ / n_));
  }
  PlanePoint at(double t) const { return sum_ * (1.0 / n_) + velocity() * (t - sum_t_ / n_); }

 private:
  int n_ = 0;
  double sum_t_ = 0.0, sum_tt_ = 0.0;
  PlanePoint sum_, sum_t_at_;
};

// A sea with nothing but the target, around own ship who lies still: the target moves relative to
// her, which is all that the echo can tell.
class RenderedSea {
 public:
  RenderedSea(const StandardScenario& scenario, std::uint64_t seed, RangeScale scale,
              const ScanGeometry& geometry, bool roll, double end_s)
      : end_s_(end_s),
        end_(place_at(scenario.bearing_deg, scenario.range_nm * 1852.0)),
        motion_(motion_of(scenario.relative_course_deg, scenario.relative_speed_kn)) {
    scene_ = std::make_shared<echo::Scene>(*scenes::scene_at(
        scenes::made_up_chart(kBegin, scale.length() * 1.3, 0, 7), kBegin, scale, geometry));
    scene_->seed = seed;
    scene_->own_velocity = {};
    if (roll) scene_->motion = {.roll_deg = kRoll_deg, .roll_period_s = kRoll_s};
    echo::Hull hull;
    hull.velocity = motion_;
    hull.heading_deg = scenario.true_course_deg;
    hull.length_m = 200.0;
    hull.beam_m = 30.0;
    hull.height_m = 25.0;
    hull.identity = seed;
    scene_->hulls = {hull};
  }
  // Of the target from own ship.
  PlanePoint target(double time_s) const { return end_ + motion_ * (time_s - end_s_); }
  const echo::Scene& at(ScenarioTime time) {
    scene_->time = time;
    scene_->hulls.front().centre = scene_->own_ship + target(in_seconds(time.time_since_epoch()));
    return *scene_;
  }

 private:
  double end_s_;
  PlanePoint end_, motion_;
  std::shared_ptr<echo::Scene> scene_;
};

// Own ship's heading is north, so bearings are relative ones too.
class ScenarioOnVideo {
 public:
  ScenarioOnVideo(const StandardScenario& scenario, double minutes, std::uint64_t seed,
                  const RenderedRadar& radar, const Plotter::Rule& rule)
      : scenario_(scenario),
        radar_(radar),
        geometry_{radar.spokes, radar.cells, 8},
        scale_(scale_of(scenario)),
        turns_(static_cast<std::uint64_t>(std::lround(minutes * radar.set.rpm))),
        // The antenna points at the target for the last time at the end, and at the begin for the
        // first.
        last_((turns_ + 1) * radar.spokes +
              static_cast<std::uint64_t>(std::lround(scenario.bearing_deg / 360.0 * radar.spokes))),
        clock_(radar.set.rpm, radar.spokes, roll_phase(seed)),
        end_s_(in_seconds(clock_.time_of(last_).time_since_epoch())),
        sea_(scenario, seed, scale_, geometry_, radar.errors, end_s_),
        renderer_(radar.set, geometry_, clock_, 0),
        sensors_(scenario.own_speed_kn, seed, radar.errors),
        plotter_(rule) {
    echo::ViewControls controls;
    controls.range_scale = scale_;
    renderer_.set_controls(controls);
    spoke_.header.geometry = geometry_;
    spoke_.header.range_scale = scale_;
  }

  RenderedResult result() {
    const std::uint64_t first = last_ - turns_ * radar_.spokes - radar_.spokes / 2;
    for (std::uint64_t n = first; n <= last_ + radar_.spokes / 3; ++n) {
      if ((n - first) % radar_.spokes == 0) {
        close_turn();
        sensors_.draw_antenna();
      }
      // A twelfth of a turn, and none begins where the antenna points at the target.
      const std::uint64_t twelfth = radar_.spokes / 12;
      if (n == first || (n - first) % twelfth == twelfth / 2) sensors_.draw_compass();
      look(n);
    }
    close_turn();
    judge();
    return result_;
  }

 private:
  static ScenarioTime roll_phase(std::uint64_t seed) {
    std::uint64_t state = seed * 31 + 17;
    return ScenarioTime(std::chrono::duration_cast<Duration>(
        std::chrono::duration<double>(kRoll_s * next_share(state))));
  }

  void look(std::uint64_t n) {
    const ScenarioTime time = clock_.time_of(n);
    const double t = in_seconds(time.time_since_epoch());
    const double antenna_deg = static_cast<double>(n % radar_.spokes) * 360.0 / radar_.spokes;
    SpokeHeader& header = spoke_.header;
    header.scan = static_cast<std::uint32_t>(n / radar_.spokes);
    header.index = static_cast<std::uint32_t>(n % radar_.spokes);
    header.sequence = n;
    header.scenario_time = time;
    header.heading = TrueBearing::from(degrees(sensors_.bearing_error_deg()));
    reckoned_ = reckoned_ + sensors_.velocity() * clock_.seconds_per_spoke();
    reckoned_s_ += clock_.seconds_per_spoke();
    spoke_.cells.assign(radar_.cells, 0);
    const double off_deg = std::remainder(antenna_deg - degrees_of(sea_.target(t)), 360.0);
    const bool seen = std::fabs(off_deg) <= kSector_deg;
    // Where nothing is seen a place now and then will do.
    if (seen || n % kBlock == 0) header.own_ship = plane_.to_geo(reckoned_);
    if (seen) renderer_.render(sea_.at(clock_.time_of(n - n % kBlock)), n, 1, spoke_.cells);
    plotter_.add(spoke_);
    take_plots();
  }

  void take_plots() {
    for (const Plot& plot : plotter_.new_plots()) {
      const PlanePoint truly = sea_.target(in_seconds(plot.time.time_since_epoch()));
      const PlanePoint told = place_at(plot.bearing.in_degrees(), plot.range_m);
      if (length_of(told - truly) > kNear_m) continue;
      ++result_.pieces;
      if (!best_ || plot.cells > best_->cells) best_ = plot;
    }
  }

  // The largest plot of the turn is the target's.
  void close_turn() {
    if (!best_) return;
    ++result_.turns;
    --result_.pieces;
    const double t = in_seconds(best_->time.time_since_epoch());
    const PlanePoint truly = sea_.target(t);
    const PlanePoint told = place_at(best_->bearing.in_degrees(), best_->range_m);
    line_.add(t - end_s_, told);
    const double turn =
        (best_->bearing - TrueBearing::from(degrees(degrees_of(truly)))).in_radians();
    result_.plots.push_back({best_->range_m - length_of(truly), turn * length_of(truly),
                             best_->range_sigma_m, best_->bearing_sigma_rad * best_->range_m});
    best_.reset();
  }

  void judge() {
    const PlanePoint truly = sea_.target(end_s_);
    std::optional<PlottedTrack> nearest;
    double least_m = kNearTrack_m;
    for (const PlottedTrack& track : plotter_.tracks()) {
      const double off_m = length_of(place_at(track.bearing.in_degrees(), track.range_m) - truly);
      ++result_.false_tracks;
      if (off_m >= least_m) continue;
      least_m = off_m;
      nearest = track;
    }
    if (nearest) {
      --result_.false_tracks;
      result_.track = errors_of(scenario_, *nearest);
    }
    if (line_.count() < 3) return;
    PlottedTrack told;
    told.relative_velocity_mps = line_.velocity();
    told.range_m = length_of(line_.at(0.0));
    told.bearing = TrueBearing::from(degrees(degrees_of(line_.at(0.0))));
    told.velocity_mps = line_.velocity() + reckoned_ * (1.0 / reckoned_s_);
    result_.line = errors_of(scenario_, told);
  }

  static constexpr std::uint64_t kBlock = 16;  // spokes of one scene

  const StandardScenario scenario_;
  const RenderedRadar& radar_;
  ScanGeometry geometry_;
  RangeScale scale_;
  std::uint64_t turns_, last_;
  echo::SpokeClock clock_;
  double end_s_;
  RenderedSea sea_;
  echo::SpokeRenderer renderer_;
  FaultySensors sensors_;
  Plotter plotter_;
  echo::LocalPlane plane_{kBegin};
  PlanePoint reckoned_;  // own ship's place by gyro and log
  double reckoned_s_ = 0.0;
  Spoke spoke_;
  std::optional<Plot> best_;
  PlotLine line_;
  RenderedResult result_;
};

}  // namespace

RangeScale scale_of(const StandardScenario& scenario) {
  return *RangeScale::find(scenario.range_nm > 3.0 ? 12.0 : 3.0);
}

Plotter::Rule rule_of_all() {
  Plotter::Rule rule;
  rule.tracks.acquire = Tracker::Acquire::all;
  return rule;
}

Plotter::Rule rule_knowing_the_pulse(const StandardScenario& scenario, const RenderedRadar& radar) {
  Plotter::Rule rule = rule_of_all();
  rule.plots.pulse_m = 0.5 * echo::kLightSpeed * radar.set.pulse_for(scale_of(scenario)).length_s;
  return rule;
}

RenderedResult rendered_run(const StandardScenario& scenario, double minutes, std::uint64_t seed,
                            const RenderedRadar& radar, const Plotter::Rule& rule) {
  return ScenarioOnVideo(scenario, minutes, seed, radar, rule).result();
}

}  // namespace skerry::server
