#include "server/plotter/judge/track_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "server/plotter/assignment/assignment.hpp"
#include "server/plotter/judge/place_series.hpp"
#include "server/plotter/judge/set_distance.hpp"
#include "server/plotter/judge/sticky_pairing.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kTurns = 10, kSeenTurns = 5;
constexpr double kMinute_s = 60.0, kThreeMinutes_s = 180.0;

void require_range(bool sound, const char* text) {
  if (!sound) throw std::invalid_argument(text);
}

JudgeRule checked(JudgeRule rule) {
  if (rule.keep_m < 0.0) rule.keep_m = rule.cut_m / 4.0;
  require_range(rule.cut_m > 0.0 && std::isfinite(rule.cut_m), "the cut must be more than 0 m");
  require_range(rule.order >= 1.0 && rule.order <= 16.0, "the order must be 1 to 16");
  require_range(rule.step_s >= 0.0 && std::isfinite(rule.step_s), "a step must be 0 s or more");
  require_range(rule.hold_s >= 0.0 && std::isfinite(rule.hold_s), "a hold must be 0 s or more");
  require_range(rule.steady_s >= 0.0 && std::isfinite(rule.steady_s),
                "a steady time must be 0 s or more");
  require_range(rule.within_m > 0.0, "the range must be more than 0 m");
  return rule;
}

double share_of(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

// What is carried along from step to step, of a target.
struct TargetState {
  TruthSeries series;
  const std::vector<TurnLook>* looks;
  std::size_t looked = 0;  // looks until now
  std::optional<double> first_seen_s = {}, first_tracked_s = {};
  std::size_t since_first = 0;  // steps
  bool was_tracked = false;
  std::size_t track = kUnpaired;  // the present one
  double held_since_s = 0.0;
  std::set<std::size_t> numbers = {};
};

class Judging {
 public:
  Judging(const Truth& truth, const Told& told, const JudgeRule& rule)
      : rule_(checked(rule)),
        plane_(plane_of(truth)),
        own_(truth.own_ship, plane_),
        pairing_(rule_.cut_m, rule_.keep_m) {
    for (const TruthTarget& target : truth.targets) {
      states_.push_back({TruthSeries(target.points, plane_), &target.looks});
      score_.targets.emplace_back().id = target.id;
      if (!target.looks.empty()) score_.targets.back().five_of_ten = FiveOfTen{};
    }
    for (const ToldTrack& track : told.tracks) {
      shown_.emplace_back(track.points, plane_);
      score_.tracks.push_back({track.number, 0, 0, 0});
    }
    last_target_.resize(shown_.size(), kUnpaired);
    of_track_.resize(shown_.size());
    score_.name = told.name;
    score_.rule = rule_;
  }

  SceneScore result() {
    const std::vector<double> times = steps();
    score_.first_s = times.front();
    score_.hours = (times.back() - times.front()) / 3600.0;
    for (const double utc_s : times) step(utc_s);
    finish();
    return std::move(score_);
  }

 private:
  std::vector<double> steps() const {
    double first_s = 1e300, last_s = -1e300;
    for (const TargetState& state : states_) {
      if (state.series.empty()) continue;
      first_s = std::min(first_s, state.series.first_s());
      last_s = std::max(last_s, state.series.last_s());
    }
    if (first_s > last_s) throw std::invalid_argument("the truth has no target");
    std::vector<double> times;
    if (rule_.step_s == 0.0) {
      for (const ToldSeries& track : shown_)
        for (const ToldPoint& point : track.points())
          if (point.utc_s >= first_s - TruthSeries::kBeyond_s &&
              point.utc_s <= last_s + TruthSeries::kBeyond_s)
            times.push_back(point.utc_s);
      std::sort(times.begin(), times.end());
      times.erase(std::unique(times.begin(), times.end()), times.end());
      if (times.empty()) throw std::invalid_argument("nothing was told while the truth is known");
    } else {
      const double count = std::floor((last_s - first_s) / rule_.step_s + 1e-6);
      require_range(count < static_cast<double>(kMostJudgedSteps),
                    "more than 200000 steps: make them longer, or the truth shorter");
      for (double i = 0.0; i <= count; i += 1.0) times.push_back(first_s + i * rule_.step_s);
    }
    require_range(times.size() <= kMostJudgedSteps,
                  "more than 200000 times at which something was told");
    return times;
  }

  bool is_within(PlanePoint place, const std::optional<PlaneState>& own) const {
    return !own || length_of(place - own->place) <= rule_.within_m;
  }

  void step(double utc_s) {
    const auto own = own_.at(utc_s);
    // All that is there, then all that is shown.
    std::vector<StickyPairing::Named> truth, told;
    std::vector<PlaneState> motion;
    std::vector<ToldSeries::Shown> shown;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      TargetState& state = states_[i];
      see(state, utc_s);
      const auto now = state.series.at(utc_s);
      if (!now) {
        state.was_tracked = false;  // it is gone: that is no break
        state.track = kUnpaired;
        continue;
      }
      truth.push_back({i, now->place});
      motion.push_back(*now);
    }
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const auto now = shown_[i].at(utc_s, rule_.hold_s);
      if (!now) continue;
      told.push_back({i, now->state.place});
      shown.push_back(*now);
    }
    require_range(told.size() <= kMostShown, "more than 2000 tracks at a time");
    const auto pairs = pairing_.pair(truth, told);
    std::vector<PlanePoint> counted_truth, counted_told;
    std::vector<std::size_t> owner(told.size(), kUnpaired);
    StepScore step;
    step.utc_s = utc_s;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool counts = has_been_seen(truth[i].name, utc_s) && is_within(truth[i].place, own);
      if (pairs[i] != kUnpaired) owner[pairs[i]] = i;
      if (!counts) {
        states_[truth[i].name].was_tracked = false;  // as if it were gone
        continue;
      }
      counted_truth.push_back(truth[i].place);
      if (pairs[i] == kUnpaired) {
        ++step.missed;
        miss(truth[i].name);
      } else {
        hit(truth[i].name, told[pairs[i]].name, utc_s, motion[i], shown[pairs[i]], own);
      }
    }
    for (std::size_t j = 0; j < told.size(); ++j) {
      ToldScore& track = score_.tracks[told[j].name];
      const bool paired = owner[j] != kUnpaired;
      // One on a target that does not count is neither right nor wrong.
      const bool counts = paired ? has_been_seen(truth[owner[j]].name, utc_s) &&
                                       is_within(truth[owner[j]].place, own)
                                 : is_within(told[j].place, own);
      if (!counts) continue;
      ++track.steps;
      if (paired) ++track.paired;
      if (!paired) ++step.made_up;
      counted_told.push_back(told[j].place);
    }
    measure(step, counted_truth, counted_told);
  }

  void measure(StepScore& step, const std::vector<PlanePoint>& truth,
               const std::vector<PlanePoint>& told) {
    step.truth = truth.size();
    step.told = told.size();
    step.ospa_m = ospa_m(truth, told, rule_.cut_m, rule_.order);
    const Gospa parts = gospa(truth, told, rule_.cut_m, rule_.order);
    const double each = std::pow(rule_.cut_m, rule_.order) / 2.0;
    step.gospa_m = parts.m;
    step.missed_part = each * static_cast<double>(parts.missed);
    step.made_up_part = each * static_cast<double>(parts.made_up);
    step.errors_part =
        std::max(0.0, std::pow(parts.m, rule_.order) - step.missed_part - step.made_up_part);
    score_.steps.push_back(step);
  }

  static void see(TargetState& state, double utc_s) {
    const std::vector<TurnLook>& looks = *state.looks;
    for (; state.looked < looks.size() && looks[state.looked].utc_s <= utc_s; ++state.looked) {
      if (looks[state.looked].seen && !state.first_seen_s)
        state.first_seen_s = looks[state.looked].utc_s;
    }
    if (looks.empty() && !state.first_seen_s && !state.series.empty())
      state.first_seen_s = state.series.first_s();
  }

  bool has_been_seen(std::size_t target, double utc_s) const {
    return states_[target].first_seen_s && *states_[target].first_seen_s <= utc_s;
  }

  // Seen in five of the last ten turns, and tracked before.
  bool is_due(const TargetState& state) const {
    if (!state.first_tracked_s || state.looked < kTurns) return false;
    std::size_t seen = 0;
    for (std::size_t i = state.looked - kTurns; i < state.looked; ++i)
      seen += (*state.looks)[i].seen ? 1 : 0;
    return seen >= kSeenTurns;
  }

  void count(std::size_t target, bool tracked) {
    TargetScore& score = score_.targets[target];
    TargetState& state = states_[target];
    ++score.steps;
    if (tracked) ++score.tracked;
    if (score.five_of_ten && is_due(state)) {
      ++score.five_of_ten->due;
      if (tracked) ++score.five_of_ten->kept;
    }
    if (state.first_tracked_s) ++state.since_first;
  }

  void miss(std::size_t target) {
    count(target, false);
    if (states_[target].was_tracked) ++score_.targets[target].breaks;
    states_[target].was_tracked = false;
    states_[target].track = kUnpaired;
  }

  void hit(std::size_t target, std::size_t track, double utc_s, const PlaneState& truth,
           const ToldSeries::Shown& shown, const std::optional<PlaneState>& own) {
    TargetState& state = states_[target];
    TargetScore& score = score_.targets[target];
    if (!state.first_tracked_s) {
      state.first_tracked_s = utc_s;
      score.initiation_s = utc_s - *state.first_seen_s;
    }
    count(target, true);
    state.was_tracked = true;
    state.numbers.insert(track);
    if (last_target_[track] != kUnpaired && last_target_[track] != target) ++score.swaps;
    last_target_[track] = target;
    of_track_[track].insert(target);
    if (state.track != track) state.held_since_s = utc_s;
    state.track = track;
    TrackError error = motion_error(truth, shown, own);
    error.utc_s = utc_s;
    error.track = track;
    if (own && keep_on(state, utc_s, rule_.steady_s))
      add_forecast_error(error, utc_s, truth, shown, *own);
    error.settled = settled(state, utc_s);
    score.errors.push_back(error);
  }

  // Both, from so long before to as much after.
  bool keep_on(const TargetState& state, double utc_s, double window_s) const {
    return own_.is_steady(utc_s, window_s) && state.series.is_steady(utc_s, window_s);
  }

  Settled settled(const TargetState& state, double utc_s) const {
    const auto kept_for = [&](double length_s) {
      return utc_s - state.held_since_s >= length_s - 1e-3 &&
             keep_on(state, utc_s - length_s / 2.0, length_s / 2.0);
    };
    if (!kept_for(kMinute_s)) return Settled::no;
    return kept_for(kThreeMinutes_s) ? Settled::three_minutes : Settled::one_minute;
  }

  void finish(TargetScore& score, const TargetState& state) const {
    score.numbers = state.numbers.size();
    score.tracked_share = share_of(score.tracked, score.steps);
    score.continuity = share_of(score.tracked, state.since_first);
    std::vector<double> places;
    double sum = 0.0;
    for (const TrackError& error : score.errors) {
      places.push_back(error.place_m);
      sum += error.place_m * error.place_m;
      if (error.cpa_nm) ++score.forecasts;
    }
    if (!places.empty()) score.place_rms_m = std::sqrt(sum / static_cast<double>(places.size()));
    score.place_95_m = percentile_of(std::move(places), 95.0);
    score.course_95_deg = error_95(score.errors, &TrackError::course_deg);
    score.speed_95_kn = error_95(score.errors, &TrackError::speed_kn);
    score.cpa_95_nm = error_95(score.errors, &TrackError::cpa_nm);
    score.tcpa_95_min = error_95(score.errors, &TrackError::tcpa_min);
    score.after_one_minute = accuracy_after(score.errors, Settled::one_minute, kAfterOneMinute);
    score.after_three_minutes =
        accuracy_after(score.errors, Settled::three_minutes, kAfterThreeMinutes);
  }

  void finish() {
    const auto count = static_cast<double>(score_.steps.size());
    for (const StepScore& step : score_.steps) {
      score_.mean_ospa_m += step.ospa_m / count;
      score_.mean_gospa_m += step.gospa_m / count;
      score_.mean_missed += static_cast<double>(step.missed) / count;
      score_.mean_made_up += static_cast<double>(step.made_up) / count;
    }
    std::size_t there = 0, tracked = 0, shown = 0, paired = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      TargetScore& score = score_.targets[i];
      finish(score, states_[i]);
      there += score.steps;
      tracked += score.tracked;
      score_.swaps += score.swaps;
      score_.breaks += score.breaks;
      if (score.steps > 0 && score.tracked == 0) ++score_.never_tracked;
      if (!score.five_of_ten) continue;
      if (!score_.five_of_ten) score_.five_of_ten = FiveOfTen{};
      score_.five_of_ten->due += score.five_of_ten->due;
      score_.five_of_ten->kept += score.five_of_ten->kept;
    }
    score_.tracked_share = share_of(tracked, there);
    for (std::size_t i = 0; i < score_.tracks.size(); ++i) {
      ToldScore& track = score_.tracks[i];
      track.targets = of_track_[i].size();
      shown += track.steps;
      paired += track.paired;
      if (track.steps > 0 && track.paired == 0) ++score_.false_tracks;
    }
    score_.false_share = share_of(shown - paired, shown);
    if (score_.hours > 0.0)
      score_.false_per_hour = static_cast<double>(score_.false_tracks) / score_.hours;
  }

  JudgeRule rule_;
  echo::LocalPlane plane_;
  TruthSeries own_;
  std::vector<TargetState> states_;
  std::vector<ToldSeries> shown_;
  StickyPairing pairing_;
  std::vector<std::size_t> last_target_;         // of each track
  std::vector<std::set<std::size_t>> of_track_;  // targets that each was
  SceneScore score_;
};

}  // namespace

SceneScore track_score(const Truth& truth, const Told& told, const JudgeRule& rule) {
  return Judging(truth, told, rule).result();
}

}  // namespace skerry::server
