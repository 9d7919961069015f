// skerry-picture: judges made pictures by real ones, and finds their sets.  `skerry picture` and
// `skerry radar` run it.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string_view>
#include <vector>

#include "echo/picture_tool/fit_command.hpp"
#include "echo/picture_tool/judge_command.hpp"
#include "echo/picture_tool/sheet_command.hpp"
#include "echo/picture_tool/table_command.hpp"
#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"

namespace {

using namespace skerry::echo;

constexpr const char* kPictureFooter =
    "Examples:\n"
    "  skerry picture judge halo.pcap.gz ours.mcap\n"
    "  skerry picture sheet -o sheet.png halo.pcap.gz\n"
    "  skerry picture table captures/\n"
    "Each command says more with --help.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
    "command line cannot be understood.\n";
constexpr const char* kRadarFooter =
    "Examples:\n"
    "  skerry radar fit halo.pcap.gz\n"
    "Exit codes: 0 done, 1 it could not be done, 2 the command line cannot be understood.\n";

int parsed_and_run(CLI::App& app, const std::vector<Command>& commands, int argc, char** argv) {
  app.set_version_flag("--version", "skerry-picture " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return kExitUsage;
}

// `skerry radar` runs `skerry-picture radar`.
int run(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "radar") {
    name_program("skerry radar");
    CLI::App app{"Finds the set of a recorded radar.", "skerry radar"};
    app.footer(kRadarFooter);
    return parsed_and_run(app, {make_radar_fit_command(app)}, argc - 1, argv + 1);
  }
  name_program("skerry picture");
  CLI::App app{"Judges made radar pictures by real ones.", "skerry picture"};
  app.footer(kPictureFooter);
  return parsed_and_run(app,
                        {make_picture_judge_command(app), make_picture_sheet_command(app),
                         make_picture_table_command(app)},
                        argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  watch_pipe();
  try {
    return run(argc, argv);
  } catch (const ReaderGone&) {
    return kExitOk;
  } catch (const std::exception& error) {
    return report(error.what());
  }
}
