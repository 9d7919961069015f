#include "server/plotter/tracks/target.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/plotter/plots/land_map.hpp"

namespace skerry::server {
namespace {

constexpr unsigned kLooks = 10;
// What it has earned is gone after so many turns without it: ten.
constexpr double kMostBits = 24.0;
constexpr std::uint16_t kLooksMask = (1u << kLooks) - 1;

double seconds_between(ScenarioTime from, ScenarioTime to) {
  return std::chrono::duration<double>(to - from).count();
}

double larger_sigma(const PlaceMatrix& covariance) {
  return std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
}

}  // namespace

Target::Target(const PlacedPlot& plot, double fastest_mps)
    : time_(plot.plot.time),
      first_seen_(plot.plot.time),
      last_seen_(plot.plot.time),
      first_place_{plot.measured.place(0), plot.measured.place(1)},
      plot_sigma_m_(larger_sigma(plot.measured.covariance)),
      causes_(plot.causes),
      suspicion_(plot.suspect || plot.causes.count > 0 ? 1.0 : 0.0),
      length_m_(plot.plot.length_m),
      width_m_(plot.plot.width_m) {
  MotionState state;
  state.mean.head<2>() = plot.measured.place;
  state.covariance.setZero();
  state.covariance.topLeftCorner<2, 2>() = plot.measured.covariance;
  // Any course, most of them slower than half the fastest.
  state.covariance(2, 2) = state.covariance(3, 3) = 0.0625 * fastest_mps * fastest_mps;
  state.covariance(4, 4) = 1e-4;
  imm_.start(state);
  straight_.start(state);
}

const MotionState& Target::state() const {
  return keeps_course() ? straight_.state() : imm_.state();
}

bool Target::keeps_course() const { return straight_.seconds() > 12.0; }

double Target::age_s() const { return seconds_between(first_seen_, last_seen_); }

double Target::speed_sigma_mps() const {
  const MotionMatrix& p = state().covariance;
  return std::sqrt(std::max(p(2, 2), p(3, 3)));
}

PlanePoint Target::place_at(ScenarioTime time) const {
  const MotionState& now = state();
  return now.place() + now.velocity() * seconds_between(time_, time);
}

PlanePoint Target::expected_at(ScenarioTime time) const {
  return imm_.state().place() + imm_.state().velocity() * seconds_between(time_, time);
}

double Target::gate_m(ScenarioTime time) const {
  const double t = std::clamp(seconds_between(time_, time), 0.0, 600.0);
  const MotionMatrix& p = imm_.state().covariance;
  const auto axis = [&](int i) {
    return p(i, i) + 2.0 * t * p(i, i + 2) + t * t * p(i + 2, i + 2);
  };
  // And what a change of speed adds (ImmFilter::Rule).
  const double variance =
      std::max(axis(0), axis(1)) + 0.03 * t * t * t + noise_scale_ * plot_sigma_m_ * plot_sigma_m_;
  return std::sqrt(kGate * variance);
}

void Target::go_on(ScenarioTime time) {
  const double seconds = seconds_between(time_, time);
  if (!(seconds > 0.0)) return;
  imm_.predict(seconds);
  straight_.predict(seconds);
  time_ = time;
}

MeasuredPlace Target::scaled(const PlacedPlot& plot) const {
  MeasuredPlace measured = plot.measured;
  measured.covariance *= noise_scale_;
  // To this state's time.
  const PlanePoint way = imm_.state().velocity() * seconds_between(plot.plot.time, time_);
  measured.place += PlaceVector(way.east_m, way.north_m);
  return measured;
}

Innovation Target::off(const PlacedPlot& plot) const {
  return innovation(imm_.state(), scaled(plot));
}

bool Target::is_on_old_ground(const PlacedPlot& plot, double turn_s) const {
  constexpr double kTurnsOfASpan = LandMap::kSpan, kMargin_s = 20.0;
  constexpr std::uint32_t kLately = 0xfff;  // spans that count: what went by earlier does not
  constexpr int kOld = 4;                   // of them; a ship goes by in less
  const double near_m =
      plot.plot.stood_m + plot_sigma_m_ + 0.5 * std::max(plot.plot.length_m, plot.plot.width_m);
  const double speed = std::max(length_of(imm_.state().velocity()), 0.1);
  const double here_s =
      std::min(near_m / speed, seconds_between(first_seen_, plot.plot.time)) + kMargin_s;
  const double spans = std::ceil(here_s / (kTurnsOfASpan * turn_s));
  const auto own = static_cast<unsigned>(std::clamp(spans, 0.0, 31.0));
  return std::popcount(plot.plot.stood >> own & kLately) >= kOld;
}

void Target::see(const PlacedPlot& plot, double false_per_m2) {
  const MeasuredPlace measured = scaled(plot);
  const Innovation found = innovation(imm_.state(), measured);
  signs_.take({.misfit = innovation(straight_.state(), plot.measured).distance2,
               .unlike_m = plot.plot.length_m - length_m_,
               .on_old_ground = plot.on_old_ground,
               .by_standing = plot.plot.by_standing,
               .lobe = plot.lobe,
               .on_land = plot.plot.on_land,
               .choice = plot.choice,
               .level = plot.plot.greatest});
  const double log2_density = imm_.correct(measured);
  if (straight_.correct(measured, log2_density)) straight_.start(imm_.state());
  score_bits_ = std::min(
      score_bits_ + echo::exact_log2(kSeen) + log2_density - echo::exact_log2(false_per_m2),
      kMostBits);
  if (hits_ever_ >= 3 && keeps_course()) {
    // The mean of what was shown so far, and of the last 25 or so.
    const double shown = std::min(found.distance2, 9.0) / 2.0;
    const double share = std::max(1.0 / 25.0, 1.0 / (hits_ever_ + 2.0));
    noise_scale_ = std::clamp(noise_scale_ * (1.0 + (shown - 1.0) * share), 1.0, 9.0);
  }
  plot_sigma_m_ = larger_sigma(plot.measured.covariance);
  const bool suspect = plot.suspect || plot.causes.shares_one_with(causes_);
  if (plot.causes.count > 0) causes_ = plot.causes;
  suspicion_ += ((suspect ? 1.0 : 0.0) - suspicion_) * std::max(0.1, 1.0 / (hits_ever_ + 1.0));
  length_m_ += (plot.plot.length_m - length_m_) / 5.0;
  width_m_ += (plot.plot.width_m - width_m_) / 5.0;
  shares_ = false;
  last_seen_ = plot.plot.time;
  looks_ = std::min(looks_ + 1, kLooks);
  seen_ = static_cast<std::uint16_t>((seen_ << 1 | 1) & kLooksMask);
  misses_ = 0;
  ++hits_ever_;
}

bool Target::may_share(ScenarioTime time) const {
  constexpr double kKnown_s = 60.0, kLongest_s = 300.0, kLeast_mps = 1.0;
  return length_of(straight_.state().velocity()) > kLeast_mps && straight_.seconds() > kKnown_s &&
         (!shares_ || seconds_between(shares_since_, time) < kLongest_s);
}

void Target::share(const PlacedPlot& plot) {
  if (!shares_) shares_since_ = plot.plot.time;
  shares_ = true;
  // What the models know beside the line would spread over minutes without a plot.
  imm_.start(straight_.state());
  last_seen_ = plot.plot.time;
  looks_ = std::min(looks_ + 1, kLooks);
  seen_ = static_cast<std::uint16_t>((seen_ << 1 | 1) & kLooksMask);
  misses_ = 0;
}

void Target::miss() {
  score_bits_ += echo::exact_log2(1.0 - kSeen);
  looks_ = std::min(looks_ + 1, kLooks);
  seen_ = static_cast<std::uint16_t>((seen_ << 1) & kLooksMask);
  ++misses_;
}

unsigned Target::hits() const { return static_cast<unsigned>(std::popcount(seen_)); }

}  // namespace skerry::server
