#include "server/plotter/judge/baselines/mayara.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/plotter/judge/baselines/cv_filter.hpp"
#include "server/plotter/judge/baselines/told_book.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kModels = 3;
using Shares = std::array<double, kModels>;
constexpr Shares kNoise = {0.01, 0.05, 0.15}, kBegin = {0.6, 0.2, 0.2};
constexpr std::array<Shares, kModels> kTransition = {
    {{0.90, 0.05, 0.05}, {0.10, 0.80, 0.10}, {0.05, 0.15, 0.80}}};
constexpr double kMeasured_m2 = 25.0, kVelocity_2 = 100.0;
constexpr int kPromoted = 4, kMostMissedMoving = 3, kMostMissedStill = 10, kStillUpdates = 5;
constexpr double kStill_mps = 0.5, kGate_m = 50.0, kGateTimes = 1.5;
constexpr double kMerge_m = 100.0, kMerge_deg = 30.0;
constexpr double kTurn_deg = 90.0, kTurn_mps = 5.0, kShowsCourse_m = 5.0;

// Interacting filters (Blom and Bar-Shalom 1988).
class ThreeFilters {
 public:
  explicit ThreeFilters(PlanePoint place) {
    filters_.fill(cv_begun(place, kMeasured_m2, kVelocity_2));
    mix();
  }

  void predict(double dt_s) {
    Shares next{};
    for (std::size_t j = 0; j < kModels; ++j)
      for (std::size_t i = 0; i < kModels; ++i) next[j] += kTransition[i][j] * shares_[i];
    std::array<CvState, kModels> mixed;
    for (std::size_t j = 0; j < kModels; ++j) {
      Shares of{};
      for (std::size_t i = 0; i < kModels; ++i) of[i] = kTransition[i][j] * shares_[i] / next[j];
      mixed[j] = combined(of);
      cv_predict(mixed[j], dt_s, kNoise[j]);
    }
    filters_ = mixed;
    shares_ = next;
    mix();
  }

  void update(PlanePoint place) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kModels; ++i) {
      const double likelihood =
          cv_update(filters_[i], place - filters_[i].place, {kMeasured_m2, 0.0, kMeasured_m2});
      shares_[i] *= std::max(likelihood, 1e-100);
      sum += shares_[i];
    }
    for (double& share : shares_) share /= sum;
    mix();
  }

  PlanePoint place() const { return state_.place; }
  PlanePoint velocity_mps() const { return state_.velocity_mps; }

 private:
  CvState combined(const Shares& shares) const {
    CvState out{};
    for (std::size_t k = 0; k < kModels; ++k) {
      out.place = out.place + filters_[k].place * shares[k];
      out.velocity_mps = out.velocity_mps + filters_[k].velocity_mps * shares[k];
    }
    for (std::size_t k = 0; k < kModels; ++k) {
      const PlanePoint at = filters_[k].place - out.place;
      const PlanePoint by = filters_[k].velocity_mps - out.velocity_mps;
      const std::array<double, 4> off = {at.east_m, at.north_m, by.east_m, by.north_m};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          out.p[i][j] += shares[k] * (filters_[k].p[i][j] + off[i] * off[j]);
    }
    return out;
  }
  void mix() { state_ = combined(shares_); }

  std::array<CvState, kModels> filters_;
  Shares shares_ = kBegin;
  CvState state_;
};

struct BlobTrack {
  std::size_t number = 0;
  ThreeFilters filters;
  int updates = 1, missed = 0;
  bool found = true, gone = false;

  double speed_mps() const { return length_of(filters.velocity_mps()); }
  bool is_still() const { return updates >= kStillUpdates && speed_mps() < kStill_mps; }
};

class Mayara {
 public:
  Mayara(const std::vector<DetectionScan>& scans, const MayaraRule& rule)
      : rule_(rule), plane_(plane_of(scans)), book_(plane_) {
    for (const DetectionScan& scan : scans) take(scan);
  }
  Told told() { return book_.told("mayara 2026's rules"); }

 private:
  void take(const DetectionScan& scan) {
    const double dt_s = std::clamp(scan.utc_s - last_s_, 0.0, 60.0);
    last_s_ = scan.utc_s;
    last_dt_s_ = dt_s;
    const double gate_m = std::max(kGate_m, kGateTimes * rule_.most_speed_mps * dt_s);
    for (BlobTrack& track : tracks_) {
      track.found = false;
      track.filters.predict(dt_s);
    }
    const std::size_t before = tracks_.size();
    for (const PlanePoint plot : places_of(scan, plane_)) {
      const std::size_t best = nearest(plot, gate_m, before);
      if (best < before) {
        tracks_[best].filters.update(plot);
        tracks_[best].found = true;
        ++tracks_[best].updates;
      } else if (tracks_.size() < rule_.most_targets) {
        tracks_.push_back({++count_, ThreeFilters(plot), 1, 0, true, false});
      }
    }
    for (BlobTrack& track : tracks_) {
      track.missed = track.found ? 0 : track.missed + 1;
      if (track.missed >= (track.is_still() ? kMostMissedStill : kMostMissedMoving))
        track.gone = true;
    }
    merge();
    for (const BlobTrack& track : tracks_) {
      const ToldStatus status = track.gone                  ? ToldStatus::lost
                                : track.updates < kPromoted ? ToldStatus::tentative
                                                            : ToldStatus::tracked;
      book_.tell(track.number, scan.utc_s, status, track.filters.place(),
                 track.filters.velocity_mps());
    }
    std::erase_if(tracks_, [](const BlobTrack& track) { return track.gone; });
  }

  // Of the tracks that were there before this scan.
  std::size_t nearest(PlanePoint plot, double gate_m, std::size_t before) const {
    std::size_t best = before;
    double best_m = gate_m;
    for (std::size_t i = 0; i < before; ++i) {
      const BlobTrack& track = tracks_[i];
      const PlanePoint way = plot - track.filters.place();
      const double apart_m = length_of(way);
      if (track.found || apart_m > best_m) continue;
      if (track.speed_mps() > kTurn_mps && apart_m > kShowsCourse_m) {
        const double turn = turn_between(course_of(way + track.filters.velocity_mps() * last_dt_s_),
                                         course_of(track.filters.velocity_mps()));
        if (std::fabs(turn) > kTurn_deg) continue;
      }
      best = i;
      best_m = apart_m;
    }
    return best;
  }

  void merge() {
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      for (std::size_t j = i + 1; j < tracks_.size(); ++j) {
        BlobTrack &a = tracks_[i], &b = tracks_[j];
        if (a.gone || b.gone || a.speed_mps() < kStill_mps || b.speed_mps() < kStill_mps) continue;
        if (length_of(a.filters.place() - b.filters.place()) >= kMerge_m) continue;
        const double turn =
            turn_between(course_of(a.filters.velocity_mps()), course_of(b.filters.velocity_mps()));
        if (std::fabs(turn) >= kMerge_deg) continue;
        (b.updates > a.updates ? a : b).gone = true;
      }
    }
  }

  MayaraRule rule_;
  echo::LocalPlane plane_;
  ToldBook book_;
  std::vector<BlobTrack> tracks_;
  double last_s_ = 0.0, last_dt_s_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

Told baseline_mayara(const std::vector<DetectionScan>& scans, const MayaraRule& rule) {
  return Mayara(scans, rule).told();
}

}  // namespace skerry::server
