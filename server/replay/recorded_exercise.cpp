#include "server/replay/recorded_exercise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>

#include "server/radar/sector_maker.hpp"

namespace skerry::server {
namespace {

using recording::Input;
using recording::RecordingError;

constexpr std::uint32_t kMostRadars = 64;
constexpr int kMostViews = 32;
constexpr auto kLatestNs =
    static_cast<std::uint64_t>(recording::kLatestTime.time_since_epoch().count());
// Four years of the fastest radar.
constexpr std::uint64_t kMostSpokes = std::uint64_t{1} << 40;

// Sorts an input to where it belongs; why not, if it does not.
class Sorter {
 public:
  explicit Sorter(RecordedExercise& exercise) : exercise_(exercise) {}

  std::optional<std::string> add(const Input& input) {
    switch (input.kind_case()) {
      case Input::kBegan:
        began_ = true;
        exercise_.epoch = UtcTime(Duration(static_cast<std::int64_t>(input.began().utc_ns())));
        exercise_.server = input.began().server();
        if (!zero_told_) exercise_.zero = exercise_.epoch;
        return std::nullopt;
      case Input::kTaken:
        return add_taken(input.taken());
      case Input::kSkipped:
        if (!known(input.skipped().radar())) return kNoRadar;
        radar(input.skipped().radar()).skipped[input.skipped().first()] = input.skipped().sectors();
        return std::nullopt;
      case Input::kReached: {
        if (!known(input.reached().radar())) return kNoRadar;
        if (input.reached().first() > kMostSpokes) return "a radar's spokes end beyond all time";
        RadarInputs& inputs = radar(input.reached().radar());
        inputs.end = std::max(inputs.end, input.reached().first() + SectorMaker::kSectorSpokes);
        return std::nullopt;
      }
      case Input::kOrder:
        exercise_.world.push_back({input.order().tick(), input});
        return std::nullopt;
      case Input::kFix:
        exercise_.world.push_back({input.fix().tick(), input});
        return std::nullopt;
      case Input::kEnvironment:
        exercise_.world.push_back({input.environment().tick(), input});
        return std::nullopt;
      case Input::kExercise:
        exercise_.world.push_back({input.exercise().tick(), input});
        return std::nullopt;
      case Input::kCheckpoint:
        exercise_.checkpoints.push_back(input.checkpoint());
        return std::nullopt;
      case Input::kZero:
        if (input.zero().utc_ns() > kLatestNs) return "a time that no clock has";
        zero_told_ = true;
        exercise_.zero = UtcTime(Duration(static_cast<std::int64_t>(input.zero().utc_ns())));
        return std::nullopt;
      case Input::kIncomplete:
        exercise_.incomplete = true;
        return std::nullopt;
      case Input::KIND_NOT_SET:
        break;
    }
    return "an input of a kind that this program does not know; a newer one may";
  }

  std::optional<std::string> missing() const {
    if (!began_) return "it does not say when the exercise began";
    for (const RadarInputs& inputs : exercise_.radars) {
      if (!inputs.warm_up) return "it has no inputs of one of its radars";
    }
    if (exercise_.radars.empty()) return "it has no inputs of a radar";
    return std::nullopt;
  }

 private:
  static constexpr const char* kNoRadar = "inputs of a radar beyond the 64 that there can be";
  static bool known(std::uint32_t radar) { return radar < kMostRadars; }
  RadarInputs& radar(std::uint32_t number) {
    if (exercise_.radars.size() <= number) exercise_.radars.resize(number + 1);
    return exercise_.radars[number];
  }
  std::optional<std::string> add_taken(const Input::Taken& taken) {
    if (!known(taken.radar())) return kNoRadar;
    if (taken.first() % SectorMaker::kSectorSpokes != 0) {
      return fmt::format("inputs from spoke {} on, which begins no sector", taken.first());
    }
    if (taken.views_size() > kMostViews) {
      return fmt::format("{} views of a radar; there can be {}", taken.views_size(), kMostViews);
    }
    RadarInputs& inputs = radar(taken.radar());
    if (taken.warm_up()) {
      inputs.warm_up = taken;
    } else {
      inputs.taken[taken.first()] = taken;
    }
    return std::nullopt;
  }

  RecordedExercise& exercise_;
  bool began_ = false, zero_told_ = false;
};

}  // namespace

bool RadarInputs::is_skipped(std::uint64_t first) const {
  const auto after = skipped.upper_bound(first);
  if (after == skipped.begin()) return false;
  const auto& [begin, sectors] = *std::prev(after);
  return (first - begin) / SectorMaker::kSectorSpokes < sectors;
}

Result<RecordedExercise, RecordingError> RecordedExercise::read(
    const recording::RecordingReader& reader) {
  RecordedExercise exercise;
  const auto wrong = [&](std::string text) {
    return Failure{RecordingError{reader.summary().file, 0, std::move(text)}};
  };
  for (const recording::Attachment& document : reader.summary().attachments) {
    if (document.name == kScenarioDocument) exercise.scenario_yaml = document.bytes;
    if (document.name == kChartsDocument) exercise.charts_json = document.bytes;
  }
  Sorter sorter(exercise);
  recording::ItemCursor items = reader.items({{recording::Kind::input}});
  bool any = false;
  while (const auto item = items.next()) {
    Input input;
    if (!input.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      return wrong("an input that is no Input message");
    }
    if (auto fault = sorter.add(input)) return wrong(*std::move(fault));
    any = true;
  }
  if (!any || exercise.scenario_yaml.empty()) {
    return wrong(
        "it has no inputs of an exercise: only what skerryd records of its own radars can be made "
        "again, not captures, playbacks and real radars");
  }
  if (auto fault = sorter.missing()) return wrong(*std::move(fault));
  std::stable_sort(exercise.world.begin(), exercise.world.end(),
                   [](const WorldInput& a, const WorldInput& b) { return a.tick < b.tick; });
  return exercise;
}

Duration length_to_replay(const recording::RecordingReader& reader,
                          const RecordedExercise& exercise, std::optional<Duration> wanted,
                          const std::string& option) {
  constexpr Duration kLongest = std::chrono::hours(48);
  const recording::Summary& summary = reader.summary();
  const Duration whole = summary.end - exercise.zero;
  if (whole < Duration::zero()) {
    throw std::runtime_error(fmt::format(
        "{}: the recording ends {:.0f} s before its exercise begins; expected times after it",
        summary.file, -in_seconds(whole)));
  }
  if (wanted) return *wanted;
  if (whole > kLongest) {
    throw std::runtime_error(fmt::format(
        "{}: the recording says that it ends {:.0f} hours after its exercise began; if that is so, "
        "say with {} how many minutes of it are wanted",
        summary.file, in_seconds(whole) / 3600.0, option));
  }
  return whole;
}

}  // namespace skerry::server
