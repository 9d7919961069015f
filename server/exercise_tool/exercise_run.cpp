#include "server/exercise_tool/exercise_run.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

constexpr int kTicksInSecond = 10;
constexpr double kUsualLength_min = 30.0;

Duration in_minutes(double minutes) { return seconds_as_duration(60.0 * minutes); }

}  // namespace

double length_in_minutes(const scenario::Scenario& scenario) {
  return scenario.has_exercise() ? scenario.exercise().length_min() : kUsualLength_min;
}

ExerciseRun::ExerciseRun(const ExercisePlan& plan, const echo::ChartSource& chart,
                         const Options& options)
    : plan_(plan),
      chart_(chart),
      options_(options),
      world_(plan.scenario),
      length_(in_minutes(options.until_min > 0.0 ? options.until_min
                                                 : length_in_minutes(plan.scenario))) {
  if (!options.checks) return;
  for (const auto& check : plan.scenario.exercise().checks()) due_.push_back(&check);
  std::stable_sort(due_.begin(), due_.end(),
                   [](const auto* a, const auto* b) { return a->at_min() > b->at_min(); });
}

void ExerciseRun::judge_due(const Listener& listener) {
  const Duration now = World::kTick * static_cast<std::int64_t>(world_.tick());
  while (!due_.empty() && in_minutes(due_.back()->at_min()) <= now) {
    std::vector<CheckedTurn> turns;
    const CheckResult result =
        judge(*due_.back(), plan_, chart_, world_, options_.keep_turns ? &turns : nullptr);
    due_.pop_back();
    ++judged_;
    if (!result.passed()) ++failed_;
    if (listener.judged) listener.judged(result, turns);
  }
}

void ExerciseRun::hear_marks(const Listener& listener) {
  const auto log = world_.state().log;
  for (std::size_t i = heard_.size(); i < log->marks.size(); ++i) {
    heard_.push_back(log->marks[i]);
    if (listener.marked) listener.marked(log->marks[i]);
  }
}

bool ExerciseRun::run(const Listener& listener) {
  const auto seconds = static_cast<std::int64_t>(std::ceil(in_seconds(length_)));
  for (std::int64_t second = 0;; ++second) {
    const WorldState state = world_.state();
    approaches_.look(state);
    hear_marks(listener);
    judge_due(listener);
    if (listener.second && !listener.second(std::chrono::seconds(second))) return false;
    if (second >= seconds) return true;
    for (int tick = 0; tick < kTicksInSecond; ++tick) world_.step();
    // A scenario may stop its clock; nobody is here to start it again.
    if (world_.state().frozen) {
      wire::ExerciseOrder go;
      go.mutable_clock()->set_frozen(false);
      world_.order(go, "the run");
    }
  }
}

}  // namespace skerry::server
