// skerry-access: the file of tokens that skerryd reads.  `skerry token` runs it.
#include <fmt/format.h>

#include <exception>

#include "echo/tool_console/console.hpp"
#include "server/access_tool/token_command.hpp"

namespace {

using namespace skerry::server;
namespace console = skerry::echo;

int run(int argc, char** argv) {
  CLI::App app{"Makes, lists and revokes tokens: who may see and change what on a skerryd.",
               "skerry token"};
  app.set_version_flag("--version", "skerry-access " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "The file has of each token only what it is known again by.  Exit codes: 0 done, 1 it could\n"
      "not be done, 2 the command line cannot be understood.\n"
      "Examples:\n"
      "  skerry token new bridge-1 --role trainee --ship Frida --for 8h\n"
      "  skerry token new wall-display\n"
      "  skerry token list --tokens school.yaml\n"
      "  skerry token revoke bridge-1\n"
      "  skerry token rights\n");
  const auto commands = make_token_commands(app);
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
  console::name_program("skerry token");
  console::watch_pipe();
  try {
    return run(argc, argv);
  } catch (const console::ReaderGone&) {
    return console::kExitOk;
  } catch (const std::exception& error) {
    return console::report(error.what());
  }
}
