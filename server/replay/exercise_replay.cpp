#include "server/replay/exercise_replay.hpp"

#include <fmt/format.h>

namespace skerry::server {

ExerciseReplay::ExerciseReplay(const RecordedExercise& exercise, const ExercisePlan& plan,
                               const echo::ChartSource& chart, std::size_t workers)
    : exercise_(exercise),
      world_(plan.scenario, exercise.world, plan.in_range),
      emissions_(plan.radars.size()) {
  if (plan.radars.size() != exercise.radars.size()) {
    throw ReplayError(fmt::format("the scenario has {} radars, its inputs are of {}",
                                  plan.radars.size(), exercise.radars.size()));
  }
  // In RadarServer's order: all are mounted, then warmed up.
  const WorldStatePtr state = world_.at(ScenarioTime{});
  for (std::size_t i = 0; i < plan.radars.size(); ++i) {
    radars_.push_back(std::make_unique<ReplayedRadar>(plan.radars[i], workers, exercise.radars[i],
                                                      chart, plan.coast, emissions_));
    radars_.back()->ask_for_coast(*state);
  }
  for (const auto& radar : radars_) radar->warm_up(state);
}

ExerciseReplay::~ExerciseReplay() = default;

ReplayedRadar* ExerciseReplay::next() {
  ReplayedRadar* found = nullptr;
  bool all_done = true, one_done = false;
  for (const auto& radar : radars_) {
    if (radar->is_done()) {
      one_done = true;
      continue;
    }
    all_done = false;
    if (radar->is_ready() && (found == nullptr || radar->next_time() < found->next_time())) {
      found = radar.get();
    }
  }
  // Those that wait for what another did beyond the end of its inputs end with it: a recorder that
  // was killed knows of each radar a little more or less.
  if (found == nullptr && !all_done && !one_done) {
    throw ReplayError("its radars wait for each other: inputs are missing or in a wrong order");
  }
  return found;
}

std::uint64_t ExerciseReplay::spokes_to_make() const {
  std::uint64_t spokes = 0;
  for (const RadarInputs& inputs : exercise_.radars) spokes += inputs.end;
  return spokes;
}

bool ExerciseReplay::run(const Sink& sink, const Progress& progress) {
  const auto total = static_cast<double>(std::max<std::uint64_t>(1, spokes_to_make()));
  std::uint64_t made = 0, sectors = 0;
  std::vector<ViewSector> out;
  while (ReplayedRadar* radar = next()) {
    radar->step(world_, exercise_.epoch, out);
    if (world_.fault()) throw ReplayError(*world_.fault());
    for (const ViewSector& part : out) sink(part.sector);
    made += SectorMaker::kSectorSpokes;
    if (++sectors % 256 == 0 && !progress(static_cast<double>(made) / total)) return false;
  }
  progress(1.0);
  return true;
}

}  // namespace skerry::server
