// skerry-picture: judges made pictures by real ones.  `skerry picture` runs it.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>

#include "echo/picture_tool/judge_command.hpp"
#include "echo/picture_tool/table_command.hpp"
#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"

namespace {

using namespace skerry::echo;

int run(int argc, char** argv) {
  CLI::App app{"Judges made radar pictures by real ones.", "skerry picture"};
  app.set_version_flag("--version", "skerry-picture " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "Examples:\n"
      "  skerry picture judge halo.pcap.gz ours.mcap\n"
      "  skerry picture table captures/\n"
      "Each command says more with --help.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
      "command line cannot be understood.\n");
  const std::array commands = {
      make_picture_judge_command(app),
      make_picture_table_command(app),
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
  name_program("skerry picture");
  watch_pipe();
  try {
    return run(argc, argv);
  } catch (const ReaderGone&) {
    return kExitOk;
  } catch (const std::exception& error) {
    return report(error.what());
  }
}
