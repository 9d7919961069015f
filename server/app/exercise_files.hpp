// Exercise files: what a recording of an exercise keeps of its scenario and charts, and the way
// back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/core/exercise_inputs.hpp"
#include "server/replay/exercise_replay.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Which charts a server was started with; as open_charts() takes them.
struct ChartFiles {
  std::vector<std::string> charts;
  std::string elevation;
};

// A scenario file with those that it includes.
struct ScenarioFile {
  std::string yaml;  // all of it, in one text that includes nothing: what a recording keeps
  scenario::Scenario scenario;
};

// The file, or the shipped exercise of that name, or the built-in scenario for an empty path;
// checked as by exercise_scenario().  `seed` instead of the file's.
// Error: ConfigError with all that is wrong.
ScenarioFile open_scenario(const std::string& path, std::optional<std::uint64_t> seed = {});

// parse_scenario() and what the radars and the coast need beyond it.
// Error: ConfigError with all that is wrong.
scenario::Scenario exercise_scenario(const std::string& yaml, const std::string& file_name);

// "scenario.yaml" and "charts.json".  The latter has path, size and a digest (SHA-256 of the size,
// the first and the last MiB) of each chart named, and of the GSHHG file that stands behind them.
std::vector<ExerciseDocument> exercise_documents(const std::string& scenario_yaml,
                                                 const ChartFiles& files);

// By what two servers see that they have the same exercise: a line each for scenario, charts,
// elevation and the world's chart, "scenario 5f3a...".  The same files give the same lines,
// wherever they lie.
std::vector<std::string> exercise_digests(const std::string& scenario_yaml,
                                          const ChartFiles& files);

// The chart files that "charts.json" names.  `instead`: those to be used in their place, by the
// same order, if there are any. Error: std::runtime_error if one is not there or is another, or the
// document makes no sense.
ChartFiles recorded_charts(const std::string& charts_json, const ChartFiles& instead);

// The plan that RadarServer makes of that scenario.
// Error: as exercise_scenario().
ExercisePlan exercise_plan(const std::string& scenario_yaml, const std::string& file_name);
ExercisePlan exercise_plan(scenario::Scenario scenario);  // of one that was checked

}  // namespace skerry::server
