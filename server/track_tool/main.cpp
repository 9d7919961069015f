// skerry-track: a target plotter over recordings and captures.  `skerry track` runs it.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <exception>

#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"
#include "server/track_tool/commands.hpp"

namespace {

using namespace skerry::server;
namespace console = skerry::echo;

// An option of the application's own that stands before a subcommand, which would not heed it.
const CLI::Option* stray_option(const CLI::App& app) {
  if (app.get_subcommands().empty()) return nullptr;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0) return option;
  }
  return nullptr;
}

int run(int argc, char** argv) {
  CLI::App app{"Finds and tracks targets in the video of a recording or a capture.",
               "skerry track"};
  app.set_version_flag("--version", "skerry-track " SKERRY_VERSION);
  app.require_subcommand(0, 1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "The plotter knows nothing but the spokes, so it works on any radar's.  A file that has a\n"
      "subcommand's name is given as ./truth.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
      "command line cannot be understood.\n"
      "Examples:\n"
      "  skerry track watch.mcap -o tracks.csv\n"
      "  skerry track halo20-ranges.pcap.gz -o tracks.geojson --plots plots.csv\n"
      "  skerry track watch.mcap -o tracks.csv --radar 1 --from 10:00 --until 25:00\n"
      "  skerry track watch.mcap -o tracks.mcap\n"
      "  skerry track recorded watch.mcap -o known.csv\n"
      "  skerry track truth watch.mcap -o truth.csv\n"
      "  skerry track judge --truth truth.csv --told tracks.csv --page judged.html\n");
  const console::Command track = make_track_command(app);
  const std::array subcommands = {make_recorded_command(app), make_truth_command(app),
                                  make_judge_command(app)};
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return console::kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? console::kExitOk : console::kExitUsage;
  }
  if (const CLI::Option* stray = stray_option(app)) {
    console::report(fmt::format("{} is not an option of {}", stray->get_name(),
                                app.get_subcommands().front()->get_name()),
                    "Options of a subcommand stand behind it.");
    return console::kExitUsage;
  }
  for (const console::Command& command : subcommands) {
    if (command.app->parsed()) return command.run();
  }
  return track.run();
}

}  // namespace

int main(int argc, char** argv) {
  console::name_program("skerry track");
  console::watch_pipe();
  spdlog::set_level(spdlog::level::warn);
  try {
    return run(argc, argv);
  } catch (const console::ReaderGone&) {
    return console::kExitOk;
  } catch (const std::exception& error) {
    return console::report(error.what());
  }
}
