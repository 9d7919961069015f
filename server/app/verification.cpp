#include "server/app/verification.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <stdexcept>

#include "protocol/recording/reader.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/version.hpp"
#include "server/replay/comparison.hpp"
#include "server/replay/video_file.hpp"

namespace skerry::server {
namespace {

bool show_progress(double share) {
  static const bool terminal = isatty(STDERR_FILENO) == 1;
  if (terminal) std::fprintf(stderr, "\rmaking the video again: %3.0f %%", 100.0 * share);
  if (terminal && share >= 1.0) std::fputc('\n', stderr);
  return true;
}

void print(const ComparisonResult& result) {
  fmt::print("made again       {} spokes\n", result.made);
  if (result.compared > 0) {
    fmt::print("recorded spokes  {} compared byte by byte, {} different\n", result.compared,
               result.different);
  }
  if (result.missing > 0) fmt::print("                 {} never made again\n", result.missing);
  if (result.checkpoints + result.checkpoints_wrong > 0) {
    fmt::print("checkpoints      {} of {} spokes, {} wrong\n", result.checkpoints, result.hashed,
               result.checkpoints_wrong);
  }
  fmt::print("SHA-256          {}\n", result.sha256);
  if (!result.first_difference.empty()) {
    fmt::print("first difference {}\n", result.first_difference);
  }
  fmt::print("{}\n", result.is_empty()       ? "nothing was recorded to compare with"
                     : result.is_identical() ? "identical"
                                             : "NOT identical");
}

}  // namespace

int verify(const VerifyOptions& options) {
  const auto reader = recording::RecordingReader::open(options.file);
  if (!reader) throw std::runtime_error(reader.error().to_string());
  const auto exercise = RecordedExercise::read(*reader);
  if (!exercise) throw std::runtime_error(exercise.error().to_string());
  if (exercise->server != kServerName) {
    fmt::print(stderr, "note: {} made this recording, this is {}: another version may differ\n",
               exercise->server, kServerName);
  }
  if (exercise->incomplete) {
    fmt::print(stderr, "note: inputs are missing at the end; the video ends where they do\n");
  }
  const ExercisePlan plan =
      exercise_plan(exercise->scenario_yaml, options.file + ": " + kScenarioDocument);
  const ChartFiles files = exercise->charts_json.empty()
                               ? options.instead
                               : recorded_charts(exercise->charts_json, options.instead);
  const auto chart = open_charts(files.charts, files.elevation);
  ExerciseReplay replay(*exercise, plan, *chart, options.workers);
  Comparison comparison(*reader, *exercise);
  std::optional<VideoFile> video;
  if (!options.video.empty()) video.emplace(options.video, *reader, exercise->zero);
  replay.run(
      [&](const Sector& sector) {
        for (const SpokePtr& spoke : sector.spokes) {
          comparison.add(*spoke);
          if (video) video->add(*spoke);
        }
      },
      show_progress);
  if (video) video->finish();
  const ComparisonResult result = comparison.finish();
  print(result);
  return result.is_identical() && (!result.is_empty() || video) ? 0 : 1;
}

}  // namespace skerry::server
