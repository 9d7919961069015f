// RecordedExercise: the inputs of an exercise as a recording has them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/reader.hpp"

namespace skerry::server {

// The inputs of one radar, by the first spoke of sectors.
struct RadarInputs {
  std::optional<recording::Input::Taken> warm_up;
  std::map<std::uint64_t, recording::Input::Taken> taken;
  std::map<std::uint64_t, std::uint64_t> skipped;  // first spoke -> sectors
  std::uint64_t end = 0;  // its inputs are known for sectors that begin before this spoke

  bool is_skipped(std::uint64_t first) const;
};

// An input of the world from a tick on: Order, Fix or Environment.
struct WorldInput {
  std::uint64_t tick = 0;
  recording::Input input;
};

struct RecordedExercise {
  UtcTime epoch{};     // scenario time 0
  UtcTime zero{};      // the same among the times of items
  std::string server;  // what made it
  std::string scenario_yaml;
  std::string charts_json;  // "" if the recording does not say
  std::vector<RadarInputs> radars;
  std::vector<WorldInput> world;  // by tick; at equal ticks, as given
  std::vector<recording::Input::Checkpoint> checkpoints;
  bool incomplete = false;  // inputs are missing at the end

  // Error: the recording has no inputs (a capture, a playback), or they make no sense.
  static Result<RecordedExercise, recording::RecordingError> read(
      const recording::RecordingReader& reader);
};

// How much of it is made again, from its begin: `wanted`, or to the recording's end.
// Error: std::runtime_error if the recording ends before its exercise begins, or more than 48 hours
// after it (a damaged time) and nothing is wanted; it then names `option`, which says how much.
Duration length_to_replay(const recording::RecordingReader& reader,
                          const RecordedExercise& exercise, std::optional<Duration> wanted,
                          const std::string& option);

inline const std::string kScenarioDocument = "scenario.yaml";
inline const std::string kChartsDocument = "charts.json";

}  // namespace skerry::server
