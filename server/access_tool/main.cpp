// skerry-access: the files of tokens and users that skerryd reads, that of who did what, and
// certificates.  `skerry token`, `skerry user`, `skerry audit` and `skerry tls` run it.
#include <fmt/format.h>

#include <exception>
#include <string_view>
#include <vector>

#include "echo/tool_console/console.hpp"
#include "server/access_tool/audit_command.hpp"
#include "server/access_tool/tls_command.hpp"
#include "server/access_tool/token_command.hpp"
#include "server/access_tool/user_command.hpp"

namespace {

using namespace skerry::server;
namespace console = skerry::echo;

struct Tool {
  const char *name, *about, *footer;
  std::vector<console::Command> (*make_commands)(CLI::App&);
};

constexpr Tool kTokens = {
    "skerry token", "Makes, lists and revokes tokens: who may see and change what on a skerryd.",
    "The file has of each token only what it is known again by.  Exit codes: 0 done, 1 it could\n"
    "not be done, 2 the command line cannot be understood.\n"
    "Examples:\n"
    "  skerry token new bridge-1 --role trainee --ship Frida --for 8h\n"
    "  skerry token new wall-display\n"
    "  skerry token new relay-2 --role observer --certificate tls/relay-2.pem\n"
    "  skerry token list --tokens school.yaml\n"
    "  skerry token revoke bridge-1\n"
    "  skerry token rights\n",
    make_token_commands};

constexpr Tool kUsers = {
    "skerry user",
    "Adds, lists and removes users: who may sign in to a skerryd by name and password.",
    "The file has Argon2id of each password, never the password.  A password is asked for twice; "
    "from\n"
    "a pipe its first line is one.  A server heeds a change within a second: who was removed, or "
    "has\n"
    "another password, is signed out.  Exit codes: 0 done, 1 it could not be done, 2 the command "
    "line\n"
    "cannot be understood.\n"
    "Examples:\n"
    "  skerry user add Anna --role instructor\n"
    "  skerry user add bridge-1 --role trainee --ship Frida --users school.yaml\n"
    "  skerry user list\n"
    "  skerry user passwd Anna\n"
    "  skerry user remove bridge-1\n",
    make_user_commands};

constexpr Tool kAudit = {
    "skerry audit", "Shows and verifies the file of who did what, which skerryd --audit writes.",
    "Each line of the file holds the digest of all before it.  Note the head now and then, away\n"
    "from the server: it finds out a file that was made anew.  Exit codes: 0 it is as it was\n"
    "written, 1 it is not or cannot be read, 2 the command line cannot be understood.\n"
    "Examples:\n"
    "  skerry audit show audit.jsonl --last 20\n"
    "  skerry audit show audit.jsonl --who Anna --kind change\n"
    "  skerry audit show watch.mcap                      # what is in a recording\n"
    "  skerry audit verify audit.jsonl\n"
    "  skerry audit verify audit.jsonl.1 audit.jsonl     # over files, the oldest first\n"
    "  skerry audit verify audit.jsonl watch.mcap        # and a recording tells the same\n"
    "  skerry audit verify audit.jsonl --head HEAD       # as `verify` or the log has told it\n",
    make_audit_commands};

constexpr Tool kTls = {
    "skerry tls",
    "Makes an authority and certificates: a skerryd encrypts by its own, and knows programs by "
    "theirs.",
    "All is made here, without any network.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
    "command line cannot be understood.\n"
    "Examples:\n"
    "  skerry tls init                                      # ./tls, for this host\n"
    "  skerry tls init /etc/skerry/tls --name radar.school --name 192.0.2.7\n"
    "  skerry tls show\n"
    "  skerry tls renew                                     # heeded by a server that runs\n"
    "  skerry tls client relay-2                            # tls/relay-2.pem, for a program\n"
    "  skerry tls client relay-2 --renew\n",
    make_tls_commands};

int run(const Tool& tool, int argc, char** argv) {
  CLI::App app{tool.about, tool.name};
  app.set_version_flag("--version", "skerry-access " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(tool.footer);
  const auto commands = tool.make_commands(app);
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

// skerry-access audit ...: the file of who did what; user ...: that of users; tls ...:
// certificates; else that of tokens.
int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  const Tool& tool = first == "audit"  ? kAudit
                     : first == "user" ? kUsers
                     : first == "tls"  ? kTls
                                       : kTokens;
  console::name_program(tool.name);
  console::watch_pipe();
  try {
    return &tool == &kTokens ? run(tool, argc, argv) : run(tool, argc - 1, argv + 1);
  } catch (const console::ReaderGone&) {
    return console::kExitOk;
  } catch (const std::exception& error) {
    return console::report(error.what());
  }
}
