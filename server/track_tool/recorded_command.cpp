#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"
#include "echo/tool_console/part_file.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/track_tool/commands.hpp"
#include "server/track_tool/recorded_tracks.hpp"

namespace skerry::server {
namespace {

struct RecordedOptions {
  std::string file, output;
  RecordedChoice choice;
};

int tell_recorded(const RecordedOptions& options) {
  if (!track_table_for(options.output, 0, [](std::string_view) {})) {
    echo::report(fmt::format("-o {}: expected {}", options.output, kTableEndings));
    return echo::kExitUsage;
  }
  echo::PartFile part(options.output);
  echo::Progress progress;
  const auto reader = recording::RecordingReader::open(options.file, [&](double share) {
    progress.show(fmt::format("searching the file: {:.0f} %", 100.0 * share));
    return true;
  });
  progress.clear();
  if (!reader) throw std::runtime_error(printable(reader.error().to_string(), 2000));
  if (const auto& damage = reader->summary().damage) {
    fmt::print(stderr, "skerry track: {}; what can be read is used\n",
               printable(damage->to_string(), 2000));
  }
  const recording::Topic topic = chosen_lists(*reader, options.choice);
  const auto table = track_table_for(options.output, topic.radar,
                                     [&](std::string_view text) { part.write(text); });
  const ListsTaken taken = write_recorded(*reader, topic, *table);
  part.finish();
  if (taken.refused > 0 || taken.chunks > 0) {
    fmt::print(stderr, "skerry track: {} lists and {} chunks could not be read\n", taken.refused,
               taken.chunks);
  }
  if (taken.by_water) {
    fmt::print(stderr,
               "skerry track: the set was stabilised by water: courses and speeds are "
               "through it\n");
  }
  echo::write_out(fmt::format("radar {} view {}: {} lists, {} targets\n", topic.radar, topic.view,
                              taken.lists, taken.targets));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_recorded_command(CLI::App& app) {
  auto options = std::make_shared<RecordedOptions>();
  CLI::App* command =
      app.add_subcommand("recorded", "The targets that the set told while it was recorded");
  command->add_option("RECORDING", options->file, "a recording (.mcap) with lists of targets")
      ->required();
  command->add_option("-o,--output", options->output, "the table, FILE.csv or FILE.geojson")
      ->required();
  command->add_option("--radar", options->choice.radar,
                      "its number; without it the first with lists");
  command->add_option("--view", options->choice.view, "its number; without it the radar's first");
  command->footer(
      "A recording has a list of targets a second, if anybody looked for them.  The columns are\n"
      "those of `skerry track FILE -o tracks.csv`; what is being acquired has neither course nor\n"
      "CPA, as on the set.  Compare it with the truth by `skerry track judge`.\n"
      "Examples:\n"
      "  skerry track recorded watch.mcap -o known.csv\n"
      "  skerry track recorded watch.mcap -o known.geojson --radar 1 --view 2\n");
  return {command, [options] { return tell_recorded(*options); }};
}

}  // namespace skerry::server
