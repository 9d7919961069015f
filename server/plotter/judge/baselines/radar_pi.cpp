#include "server/plotter/judge/baselines/radar_pi.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"
#include "server/plotter/judge/baselines/cv_filter.hpp"
#include "server/plotter/judge/baselines/told_book.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {
namespace {

constexpr double kNear_px = 2.0, kFar_px = 15.0;
constexpr double kPixelsPerScale = 512.0, kSpokesPerTurn = 2048.0;
constexpr double kRangeVariance_px2 = 25.0, kBearingVariance_spokes2 = 100.0;
constexpr double kPlaceVariance_m2 = 20.0, kVelocityVariance = 4.0, kNoisePerScan = 0.015;
constexpr int kAcquired = 6, kMostMissed = 3, kClampedUpdates = 3;
constexpr double kMostUnseen_s = 8.0, kClamp_mps = 15.0;
constexpr double kScales_nm[] = {0.125, 0.25, 0.5, 0.75, 1.0,  1.5,  2.0,  3.0,
                                 4.0,   6.0,  8.0, 12.0, 16.0, 24.0, 36.0, 48.0};

double pixel_of(const std::vector<DetectionScan>& scans) {
  double most_m = 0.0;
  for (const DetectionScan& scan : scans)
    for (const PlanePoint plot : scan.plots) most_m = std::max(most_m, length_of(plot));
  for (const double scale_nm : kScales_nm)
    if (nautical_miles(scale_nm).in_metres() >= most_m)
      return nautical_miles(scale_nm).in_metres() / kPixelsPerScale;
  return most_m / kPixelsPerScale;
}

struct PixelTarget {
  std::size_t number = 0;
  CvState state;
  double seen_s = 0.0;
  int hits = 1, missed = 0;
  bool found = false;
};

class RadarPi {
 public:
  RadarPi(const std::vector<DetectionScan>& scans, const RadarPiRule& rule)
      : rule_(rule),
        pixel_m_(rule.pixel_m > 0.0 ? rule.pixel_m : pixel_of(scans)),
        plane_(plane_of(scans)),
        book_(plane_) {
    for (const DetectionScan& scan : scans) take(scan);
  }
  Told told() { return book_.told("radar_pi's rules"); }

 private:
  void take(const DetectionScan& scan) {
    std::vector<PlanePoint> plots = places_of(scan, plane_);
    own_ = plane_.to_plane(scan.own_ship);
    const double dt_s = std::clamp(scan.utc_s - last_s_, 0.0, 60.0);
    last_s_ = scan.utc_s;
    for (PixelTarget& target : targets_) {
      target.found = false;
      move_on(target.state, dt_s);
    }
    for (PixelTarget& target : targets_) search(target, kNear_px, plots, scan.utc_s);
    for (PixelTarget& target : targets_)
      if (!target.found)
        search(target, target.hits < kAcquired ? 2.0 * kFar_px : kFar_px, plots, scan.utc_s);
    for (PixelTarget& target : targets_) tell(target, scan.utc_s);
    std::erase_if(targets_, [&](const PixelTarget& target) { return is_lost(target, last_s_); });
    for (const PlanePoint plot : plots) {
      if (targets_.size() >= rule_.most_targets) break;
      targets_.push_back(
          {++count_, cv_begun(plot, kPlaceVariance_m2, kVelocityVariance), scan.utc_s, 1, 0, true});
      tell(targets_.back(), scan.utc_s);
    }
  }

  // The state by the time; the noise as of a scan of one second.
  static void move_on(CvState& state, double dt_s) {
    cv_predict(state, dt_s, 0.0);
    CvState noise{};
    cv_predict(noise, 1.0, kNoisePerScan);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) state.p[i][j] += noise.p[i][j];
  }

  static bool is_lost(const PixelTarget& target, double utc_s) {
    return target.missed > kMostMissed || utc_s - target.seen_s > kMostUnseen_s;
  }

  void search(PixelTarget& target, double within_px, std::vector<PlanePoint>& plots, double utc_s) {
    std::size_t best = plots.size();
    double best_m = within_px * pixel_m_;
    for (std::size_t i = 0; i < plots.size(); ++i) {
      const double apart_m = length_of(plots[i] - target.state.place);
      if (apart_m > best_m) continue;
      best = i;
      best_m = apart_m;
    }
    if (best == plots.size()) return;
    measure(target.state, plots[best]);
    plots.erase(plots.begin() + static_cast<std::ptrdiff_t>(best));
    target.found = true;
    target.seen_s = utc_s;
    target.missed = 0;
    ++target.hits;
    const double speed_mps = length_of(target.state.velocity_mps);
    if (target.hits <= kClampedUpdates + 1 && speed_mps > kClamp_mps)
      target.state.velocity_mps = target.state.velocity_mps * (kClamp_mps / speed_mps);
  }

  // The extended filter's step, with range and bearing turned into along and across the line to the
  // expected place: the Jacobian is regular, so the result is the same.
  void measure(CvState& state, PlanePoint plot) const {
    const PlanePoint expected = state.place - own_, seen = plot - own_;
    const double range_m = std::max(length_of(expected), pixel_m_);
    const double bearing = std::atan2(expected.east_m, expected.north_m);
    const double off = turn_between(course_of(seen), bearing * kDegreesPerRadian);
    const double along = length_of(seen) - length_of(expected);
    const double across = range_m * off * kRadiansPerDegree;
    const double sine = std::sin(bearing), cosine = std::cos(bearing);
    const double along_2 = kRangeVariance_px2 * pixel_m_ * pixel_m_;
    const double spoke_m = range_m * kRadiansPerTurn / kSpokesPerTurn;
    const double across_2 = kBearingVariance_spokes2 * spoke_m * spoke_m;
    const PlanePoint innovation{along * sine + across * cosine, along * cosine - across * sine};
    cv_update(
        state, innovation,
        {along_2 * sine * sine + across_2 * cosine * cosine, (along_2 - across_2) * sine * cosine,
         along_2 * cosine * cosine + across_2 * sine * sine});
  }

  void tell(PixelTarget& target, double utc_s) {
    if (!target.found) ++target.missed;
    const CvState& state = target.state;
    const double speed_mps = length_of(state.velocity_mps);
    const double sigma_mps = std::sqrt(std::max({0.0, state.p[2][2], state.p[3][3]}));
    const PlanePoint shown = speed_mps < 2.0 * sigma_mps ? PlanePoint{} : state.velocity_mps;
    const ToldStatus status = is_lost(target, utc_s)    ? ToldStatus::lost
                              : target.hits < kAcquired ? ToldStatus::tentative
                                                        : ToldStatus::tracked;
    book_.tell(target.number, utc_s, status, state.place, shown);
  }

  RadarPiRule rule_;
  double pixel_m_;
  echo::LocalPlane plane_;
  ToldBook book_;
  std::vector<PixelTarget> targets_;
  PlanePoint own_;
  double last_s_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

Told baseline_radar_pi(const std::vector<DetectionScan>& scans, const RadarPiRule& rule) {
  return RadarPi(scans, rule).told();
}

}  // namespace skerry::server
