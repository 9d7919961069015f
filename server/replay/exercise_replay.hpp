// ExerciseReplay: the video of a recorded exercise, made again.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "echo/scene/coast_rules.hpp"
#include "server/replay/recorded_exercise.hpp"
#include "server/replay/replayed_radar.hpp"
#include "server/replay/replayed_world.hpp"

namespace skerry::server {

// The parts that the application makes of a scenario, as RadarServer makes them.
struct ExercisePlan {
  scenario::Scenario scenario;
  std::vector<RadarConfig> radars;
  echo::CoastRules coast;
  RangeCheck in_range;
};

// Makes sector after sector of all radars as fast as it can, in the order of time as far as radars
// do not wait for one another.  Bytes and headers are those of the exercise, from its first spoke
// on.
class ExerciseReplay {
 public:
  // `chart` must be that of the exercise.  All must outlive it.
  // Error: ReplayError if recording and plan do not agree; std::runtime_error as CoastService has.
  ExerciseReplay(const RecordedExercise& exercise, const ExercisePlan& plan,
                 const echo::ChartSource& chart, std::size_t workers);
  ~ExerciseReplay();

  // Called for each sector of each view.
  using Sink = std::function<void(const Sector&)>;
  // Share done, 0 .. 1, now and then; false gives up.
  using Progress = std::function<bool(double)>;
  // Once.  False if given up.  Error: ReplayError.
  bool run(const Sink& sink, const Progress& progress);

 private:
  ReplayedRadar* next();
  std::uint64_t spokes_to_make() const;

  const RecordedExercise& exercise_;
  ReplayedWorld world_;
  EmissionHistory emissions_;
  std::vector<std::unique_ptr<ReplayedRadar>> radars_;
};

}  // namespace skerry::server
