// skerry-coast: fits, judges and draws coasts.  `skerry coast` runs it.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>

#include "echo/coast_tool/figures_command.hpp"
#include "echo/coast_tool/fit_command.hpp"
#include "echo/coast_tool/judge_command.hpp"
#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"

namespace {

using namespace skerry::echo;

int run(int argc, char** argv) {
  CLI::App app{"Fits, judges and draws the coasts that the radar echoes of Skerry come from.",
               "skerry coast"};
  app.set_version_flag("--version", "skerry-coast " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "Examples:\n"
      "  skerry coast fit --place bergen\n"
      "  skerry coast figures -o figures.png\n"
      "  skerry coast judge --place bergen\n"
      "Each command says more with --help.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
      "command line cannot be understood.\n");
  const std::array commands = {
      make_fit_command(app),
      make_figures_command(app),
      make_judge_command(app),
  };
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

}  // namespace

int main(int argc, char** argv) {
  name_program("skerry coast");
  watch_pipe();
  try {
    return run(argc, argv);
  } catch (const ReaderGone&) {
    return kExitOk;
  } catch (const std::exception& error) {
    return report(error.what());
  }
}
