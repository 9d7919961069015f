#include "server/exercise_tool/traffic_export.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/traffic_list.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/replay/recorded_exercise.hpp"
#include "server/replay/replayed_world.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr UtcTime kUsualBegin{
    std::chrono::sys_days(std::chrono::year(2026) / 1 / 1).time_since_epoch()};

// Ships and marks as the writer shall have them.
std::vector<TrafficItem> items_of(const WorldState& state, ScenarioTime now, bool own_ships) {
  std::vector<TrafficItem> items = traffic_of(state, now);
  if (own_ships) return items;
  const auto own = static_cast<std::uint32_t>(state.scenario->own_ships_size());
  std::erase_if(items, [own](const TrafficItem& item) { return item.number <= own; });
  return items;
}

double export_scenario(const std::string& file, const TrafficExport& wanted, TrafficWriter& writer,
                       const std::function<void(double)>& progress) {
  const ExercisePlan plan = exercise_plan(open_scenario(file).scenario);
  const auto chart = open_charts({}, "");
  const UtcTime begin = wanted.begin.value_or(kUsualBegin);
  ExerciseRun run(plan, *chart, {wanted.minutes, false, false});
  run.run({{}, {}, [&](Duration now) {
             const WorldState state = run.world().state();
             writer.second(items_of(state, state.time, wanted.own_ships), begin + now);
             progress(in_seconds(now) / in_seconds(run.length()));
             return true;
           }});
  return in_seconds(run.length()) / 60.0;
}

double export_recording(const std::string& file, const TrafficExport& wanted, TrafficWriter& writer,
                        const std::function<void(double)>& progress) {
  const auto reader = recording::RecordingReader::open(file);
  if (!reader) throw std::runtime_error(reader.error().to_string());
  const auto exercise = RecordedExercise::read(*reader);
  if (!exercise) throw std::runtime_error(exercise.error().to_string());
  const ExercisePlan plan = exercise_plan(exercise->scenario_yaml, file + ": " + kScenarioDocument);
  ReplayedWorld world(plan.scenario, exercise->world, plan.in_range);
  const UtcTime begin =
      wanted.begin.value_or(std::chrono::floor<std::chrono::seconds>(exercise->epoch));
  const Duration length = length_to_replay(
      *reader, *exercise,
      wanted.minutes > 0.0 ? std::optional(seconds_as_duration(60.0 * wanted.minutes))
                           : std::nullopt,
      "--minutes");
  Duration now{};
  for (; now <= length; now += 1s) {
    const ScenarioTime time{now};
    const WorldStatePtr state = world.at(time);
    if (world.fault()) {
      throw std::runtime_error(file + ": an order does not fit its scenario: " + *world.fault());
    }
    writer.second(items_of(*state, time, wanted.own_ships), begin + now);
    progress(in_seconds(now) / std::max(in_seconds(length), 1.0));
  }
  return std::max(in_seconds(now) - 1.0, 0.0) / 60.0;
}

}  // namespace

ExportedTraffic export_traffic(const std::string& file, const TrafficExport& wanted,
                               const TrafficWriter::Sink& sink,
                               const std::function<void(double)>& progress) {
  TrafficWriter writer(wanted.form, wanted.every, sink);
  ExportedTraffic done;
  done.minutes = file.ends_with(".mcap") ? export_recording(file, wanted, writer, progress)
                                         : export_scenario(file, wanted, writer, progress);
  writer.finish();
  done.reports = writer.reports();
  done.ships = writer.ships();
  return done;
}

}  // namespace skerry::server
