// skerry recording cut and cat.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "clients/cli/number_within.hpp"
#include "clients/cli/recording/recording_command.hpp"
#include "clients/recording/position.hpp"
#include "clients/recording/recording_edit.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using recording::RecordingReader;
using recording::RecordingWriter;

// Seconds before and after --mark without --from and --to.
constexpr double kAroundMark_s = 60.0;

struct CutOptions {
  std::string file, output, mark;
  PartOptions part;
  double before_s = kAroundMark_s, after_s = kAroundMark_s;
  PackingOptions packing;
  bool force = false;
};

struct CatOptions {
  std::vector<std::string> files;
  std::string output;
  PackingOptions packing;
  bool force = false;
};

int say(const EditReport& done, const RecordingOutput& output) {
  for (const std::string& note : done.notes) fmt::print(stderr, "skerry: {}\n", note);
  if (done.chunks_damaged > 0) {
    fmt::print(stderr, "skerry: {} damaged chunks were passed over\n", done.chunks_damaged);
  }
  write_out(fmt::format("{}: {} items, {} spokes, {:.1f} MB\n", printable(output.path()),
                        done.items, done.spokes, static_cast<double>(output.bytes()) / 1e6));
  return kExitOk;
}

Result<Part, std::string> part_around_mark(const CutOptions& options,
                                           const recording::Summary& summary) {
  const auto mark = find_position("mark:" + options.mark, summary);
  if (!mark) return Failure{mark.error()};
  return Part{.from = std::max(*mark - seconds_as_duration(options.before_s), summary.begin),
              .to = *mark + seconds_as_duration(options.after_s)};
}

int run_cut(const CutOptions& options) {
  if (options.mark.empty() && options.part.from.empty() && options.part.to.empty()) {
    report("nothing says what to cut; give --from, --to or --mark");
    return kExitUsage;
  }
  const auto reader = open_recording(options.file);
  if (!reader) return kExitFailure;
  const recording::Summary& summary = reader->summary();
  const auto part =
      options.mark.empty() ? part_of(options.part, summary) : part_around_mark(options, summary);
  if (!part) return report(part.error());
  if (same_file(options.file, options.output)) {
    return report("the part would replace the recording it is cut of; give another name with -o");
  }
  RecordingOutput output(options.output, options.force);
  RecordingWriter writer(output.sink(), options.packing.writer_options());
  ProgressBar bar("cutting");
  const auto done =
      cut_recording(*reader, part->from.value_or(summary.begin),
                    part->to.value_or(summary.end + Duration(1)), writer, bar.function());
  if (!done) return report(done.error());
  finish(writer, output);
  return say(*done, output);
}

int run_cat(const CatOptions& options) {
  std::vector<RecordingReader> readers;
  for (const std::string& file : options.files) {
    auto reader = open_recording(file);
    if (!reader) return kExitFailure;
    readers.push_back(std::move(*reader));
    if (same_file(file, options.output)) {
      return report(
          fmt::format("{} would replace itself; give another name with -o", printable(file)));
    }
  }
  RecordingOutput output(options.output, options.force);
  RecordingWriter writer(output.sink(), options.packing.writer_options());
  ProgressBar bar("joining");
  const auto done = join_recordings(readers, writer, bar.function());
  if (!done) return report(done.error());
  finish(writer, output);
  return say(*done, output);
}

}  // namespace

Command make_recording_cut_command(CLI::App& recording) {
  auto options = std::make_shared<CutOptions>();
  CLI::App* command = recording.add_subcommand("cut", "Makes a recording of a part of one");
  command->add_option("FILE", options->file, "The recording")->required();
  options->part.add_options(*command);
  auto* const mark = command->add_option("--mark", options->mark,
                                         "Around the mark of that name instead of --from and --to");
  mark->excludes("--from")->excludes("--to");
  command->add_option("--before", options->before_s, "Seconds before the mark")
      ->check(number_within(0.0, 1e6))
      ->needs(mark)
      ->capture_default_str();
  command->add_option("--after", options->after_s, "Seconds after it")
      ->check(number_within(0.0, 1e6))
      ->needs(mark)
      ->capture_default_str();
  add_output(*command, options->output, options->force);
  options->packing.add_options(*command);
  command->footer(
      "Examples:\n"
      "  skerry recording cut exercise.mcap --from 1:30 --to 2:00 -o part.mcap\n"
      "  skerry recording cut exercise.mcap --from \"first contact\" -o rest.mcap\n"
      "  skerry recording cut exercise.mcap --mark collision --before 120 -o collision.mcap\n"
      "Spokes stand in the part as they were, byte by byte.\n");
  return {command, [options] { return run_cut(*options); }};
}

Command make_recording_cat_command(CLI::App& recording) {
  auto options = std::make_shared<CatOptions>();
  CLI::App* command = recording.add_subcommand("cat", "Joins recordings, by time");
  command->add_option("FILES", options->files, "The recordings")->required()->expected(2, 1000);
  add_output(*command, options->output, options->force);
  options->packing.add_options(*command);
  command->footer(
      "Examples:\n"
      "  skerry recording cat part-1.mcap part-2.mcap -o exercise.mcap\n"
      "  skerry recording cat bridge.mcap tower.mcap -o both.mcap\n"
      "Radars of the same number and name are one radar where the files follow each other; where\n"
      "they overlap, or the radars differ, the later file's get new numbers, which are told.\n");
  return {command, [options] { return run_cat(*options); }};
}

}  // namespace skerry::client
