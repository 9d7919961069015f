#include "tests/bench/plotter/tradeoff_run.hpp"

#include <algorithm>
#include <map>

#include "protocol/quantity/speed.hpp"
#include "server/app/exercise_files.hpp"
#include "server/exercise_tool/radar_turns.hpp"
#include "server/plotter/judge/place_series.hpp"
#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

using namespace skerry::server;

constexpr double kFrom_s = 60.0, kCut_m = 200.0;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A Plotter in its two parts, so that each is timed by itself.
class TimedPlotter {
 public:
  explicit TimedPlotter(const Plotter::Rule& rule)
      : extractor_(rule.plots), tracker_(rule.tracks) {}

  void turn(const Scan& scan, double floor_ns, bool counts) {
    rows_.clear();
    plots_.clear();
    double cells = 0.0;
    const double begun = thread_seconds();
    for (const auto& spoke : scan.spokes) {
      if (!spoke) continue;
      cells += static_cast<double>(spoke->cells.size());
      if (!extractor_.add(*spoke, plots_)) continue;
      const VideoRow& row = extractor_.row();
      rows_.push_back({{.time = row.time,
                        .utc = row.utc,
                        .own_ship = row.own_ship,
                        .bearing = row.bearing,
                        .reach_m = row.cell_m * static_cast<double>(row.levels.size()),
                        .width_rad = row.width_rad},
                       plots_.size()});
    }
    const double extracted = thread_seconds();
    std::size_t next = 0;
    for (const auto& [pass, plots] : rows_) {
      for (; next < plots; ++next) tracker_.add(plots_[next]);
      tracker_.pass(pass);
    }
    const double tracked = thread_seconds();
    if (!counts) return;
    const auto followed = static_cast<double>(tracker_.counts().followed);
    ns_per_cell_.push_back((extracted - begun) * 1e9 / std::max(cells, 1.0));
    floors_.push_back(ns_per_cell_.back() / floor_ns);
    us_per_target_.push_back((tracked - extracted) * 1e6 / std::max(followed, 1.0));
    followed_.push_back(followed);
    plot_count_ += plots_.size();
  }

  void tell(double utc_s) {
    for (const PlottedTrack& track : tracker_.tracks()) {
      ToldTrack& told = told_[track.number];
      told.number = std::to_string(track.number);
      told.points.push_back({.utc_s = utc_s,
                             .place = track.place,
                             .course_deg = course_of(track.velocity_mps),
                             .speed_kn = length_of(track.velocity_mps) / kKnot});
    }
  }

  ChoiceOutcome outcome(const Truth& truth, const std::string& name, const JudgeRule& rule) const {
    Told told{name, {}};
    for (const auto& [number, track] : told_) told.tracks.push_back(track);
    const auto turns = static_cast<double>(std::max<std::size_t>(followed_.size(), 1));
    return {median(ns_per_cell_),
            median(floors_),
            median(followed_),
            median(us_per_target_),
            static_cast<double>(plot_count_) / turns,
            track_score(truth, told, rule)};
  }

 private:
  PlotExtractor extractor_;
  Tracker tracker_;
  std::vector<Plot> plots_;                                // of the turn
  std::vector<std::pair<AntennaPass, std::size_t>> rows_;  // with how many plots there were then
  std::vector<double> ns_per_cell_, floors_, us_per_target_, followed_;
  std::size_t plot_count_ = 0;
  std::map<std::uint32_t, ToldTrack> told_;
};

double floor_ns() {
  static Floor floor(1024);
  constexpr int kRows = 500;
  const double begun = thread_seconds();
  for (int i = 0; i < kRows; ++i) floor.run();
  return (thread_seconds() - begun) * 1e9 / (kRows * 1024.0);
}

void tell_truth(const WorldState& state, double utc_s, Truth& truth) {
  truth.own_ship.push_back({utc_s, state.own_ships.front().position});
  truth.targets.resize(state.targets.size());
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    truth.targets[i].id = state.targets[i].name;
    truth.targets[i].points.push_back({utc_s, state.targets[i].position});
  }
}

}  // namespace

std::vector<ChoiceOutcome> try_choices(const PlotterScene& scene, double minutes,
                                       std::span<const PlotterChoice> choices,
                                       const echo::ChartSource& chart) {
  const ExercisePlan plan = exercise_plan(scene.yaml, scene.name);
  World world(plan.scenario);
  RadarTurns turns(plan, 0, std::nullopt, chart, world);
  std::vector<TimedPlotter> plotters;
  for (const PlotterChoice& choice : choices) plotters.emplace_back(choice.rule);
  const double turn_s = 60.0 / rpm_of(turns.config().set, turns.config().radar_controls);
  Truth truth;
  std::size_t turn = 0;
  while (in_seconds(turns.world().state().exercise) < 60.0 * minutes) {
    const Scan scan = turns.turn();
    const double floor = floor_ns();
    const bool counts = in_seconds(turns.world().state().exercise) >= kFrom_s;
    // Each begins once in a while: the first finds the spokes in no cache.
    for (std::size_t i = 0; i < plotters.size(); ++i)
      plotters[(i + turn) % plotters.size()].turn(scan, floor, counts);
    ++turn;
    if (!counts) continue;
    const double utc_s = turn_s * static_cast<double>(turn);
    tell_truth(turns.world().state(), utc_s, truth);
    for (TimedPlotter& plotter : plotters) plotter.tell(utc_s);
  }
  // A step is a turn; what was not told in it is not shown.
  const JudgeRule rule{.cut_m = kCut_m,
                       .order = 1.0,
                       .step_s = turn_s,
                       .hold_s = 0.4 * turn_s,
                       .within_m = turns.config().controls.range_scale.length().in_metres()};
  std::vector<ChoiceOutcome> outcomes;
  for (std::size_t i = 0; i < plotters.size(); ++i)
    outcomes.push_back(plotters[i].outcome(truth, choices[i].name, rule));
  return outcomes;
}

}  // namespace skerry::bench
