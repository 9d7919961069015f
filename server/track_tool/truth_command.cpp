#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"
#include "echo/tool_console/part_file.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/track_tool/commands.hpp"
#include "server/track_tool/truth_table.hpp"

namespace skerry::server {
namespace {

struct TruthOptions {
  std::string file, output;
  std::optional<std::uint32_t> radar;
};

int tell_truth(const TruthOptions& options) {
  if (!options.output.ends_with(".csv")) {
    echo::report(fmt::format("-o {}: expected .csv", options.output));
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
  const std::uint64_t states =
      write_truth(*reader, options.radar, [&](std::string_view text) { part.write(text); });
  part.finish();
  echo::write_out(fmt::format("{}: {} states of the exercise\n", options.output, states));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_truth_command(CLI::App& app) {
  auto options = std::make_shared<TruthOptions>();
  CLI::App* command =
      app.add_subcommand("truth", "Where the ships of a recorded exercise really were");
  command->add_option("RECORDING", options->file, "a recording (.mcap) with its exercise")
      ->required();
  command->add_option("-o,--output", options->output, "the table, FILE.csv")->required();
  command->add_option("--radar", options->radar,
                      "the id `own` is the ship that carries it; without it the first own ship");
  command->footer(
      "For referees and tests: a plotter is judged by it, and no plotter may read it.  Rows of\n"
      "utc_s,id,lat_deg,lon_deg,course_deg,speed_kn, once a second, for every ship that the\n"
      "exercise has; not for marks and buoys.  A place is at most a tick (100 ms) older than its\n"
      "time.\n"
      "Example:\n"
      "  skerry track truth watch.mcap -o truth.csv\n");
  return {command, [options] { return tell_truth(*options); }};
}

}  // namespace skerry::server
