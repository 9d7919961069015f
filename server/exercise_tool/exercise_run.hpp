// ExerciseRun: an exercise from its begin to its end, without a network.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/exercise_tool/closest_approach.hpp"
#include "server/exercise_tool/sheet_judge.hpp"

namespace skerry::server {

// Thread: one at a time.
class ExerciseRun {
 public:
  struct Options {
    double until_min = 0.0;   // 0: the sheet's length, or 30 min
    bool checks = true;       // judge them
    bool keep_turns = false;  // of checked pictures
  };
  // What is heard of while it runs; all may be empty.
  struct Listener {
    std::function<void(const wire::ExerciseMark&)> marked;  // events, texts and marks
    std::function<void(const CheckResult&, const std::vector<CheckedTurn>&)> judged;
    // After every second of the exercise; false ends the run.
    std::function<bool(Duration)> second;
  };

  // Both must outlive it.
  ExerciseRun(const ExercisePlan& plan, const echo::ChartSource& chart, const Options& options);

  // Once.  False if the listener ended it.
  bool run(const Listener& listener);

  Duration length() const { return length_; }
  const ClosestApproaches& approaches() const { return approaches_; }
  const World& world() const { return world_; }
  int judged() const { return judged_; }
  int failed() const { return failed_; }
  int not_reached() const { return plan_.scenario.exercise().checks_size() - judged_; }

 private:
  void judge_due(const Listener& listener);
  void hear_marks(const Listener& listener);

  const ExercisePlan& plan_;
  const echo::ChartSource& chart_;
  Options options_;
  World world_;
  Duration length_;
  ClosestApproaches approaches_;
  std::vector<const scenario::ExerciseCheck*> due_;  // latest first
  std::vector<wire::ExerciseMark> heard_;
  int judged_ = 0, failed_ = 0;
};

// How long an exercise is: its sheet's length, or 30 min.
double length_in_minutes(const scenario::Scenario& scenario);

}  // namespace skerry::server
