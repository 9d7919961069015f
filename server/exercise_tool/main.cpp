// skerry-exercise: makes, checks, lists and runs scenarios, debriefs recorded exercises, and reads
// and writes logs of AIS.  `skerry scenario`, `skerry exercise report` and `skerry traffic` run it.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"
#include "server/exercise_tool/commands.hpp"

namespace {

using namespace skerry::server;
namespace console = skerry::echo;

// As `skerry` hands the commands over: `skerry traffic import`, `skerry exercise report`.
std::string command_of(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  return first == "traffic" ? "skerry" : first == "report" ? "skerry exercise" : "skerry scenario";
}

int run(int argc, char** argv) {
  CLI::App app{
      "Makes, checks, lists, runs and debriefs scenarios and exercises, without a network.",
      command_of(argc, argv)};
  app.set_version_flag("--version", "skerry-exercise " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "Examples:\n"
      "  skerry scenario list\n"
      "  skerry scenario new mine.yaml --template fairway --lat 57.5 --lon 11.2\n"
      "  skerry scenario check mine.yaml\n"
      "  skerry scenario run crossing --fast --checks --pictures pictures\n"
      "  skerry traffic import harbour.nmea -o traffic.yaml\n"
      "  skerry exercise report exercise.mcap -o report.html\n"
      "Each command says more with --help.  Exit codes: 0 done, 1 it could not be done or a check\n"
      "failed, 2 the command line cannot be understood.\n");
  CLI::App& traffic = add_traffic_commands(app);
  const std::array commands = {make_new_command(app),
                               make_check_command(app),
                               make_list_command(app),
                               make_run_command(app),
                               make_report_command(app),
                               make_traffic_import_command(traffic),
                               make_traffic_export_command(traffic)};
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return console::kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? console::kExitOk : console::kExitUsage;
  }
  for (const console::Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return console::kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  console::name_program(command_of(argc, argv));
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
