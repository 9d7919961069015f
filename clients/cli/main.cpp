// skerry: looks at and controls a running skerryd from the command line.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"

namespace skerry::client {
namespace {

int run(int argc, char** argv) {
  CLI::App app{"Looks at and controls a running skerryd, the marine-radar video server.", "skerry"};
  app.set_version_flag("--version", "skerry " SKERRY_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "Examples:\n"
      "  skerry status\n"
      "  skerry doctor\n"
      "  skerry snapshot -o radar.png\n"
      "  skerry dump --count 5\n"
      "  skerry targets --by range\n"
      "  skerry set --range 6 --gain 60\n"
      "  skerry record start\n"
      "  skerry play exercise.mcap\n"
      "  skerry recording info exercise.mcap\n"
      "  skerry coast fit --place bergen\n"
      "  skerry picture judge halo.pcap ours.mcap\n"
      "  skerry track exercise.mcap -o tracks.csv\n"
      "  skerry scenario run crossing --fast --checks\n"
      "  skerry exercise fault Sirius gyro-bias=5\n"
      "  skerry exercise report exercise.mcap -o report.html\n"
      "  skerry board scope\n"
      "  skerry token new bridge-1 --role trainee --ship Frida --for 8h\n"
      "  skerry class new Frida --user Anna\n"
      "  skerry cluster status\n"
      "Each command says more with --help.  Exit codes: 0 done, 1 it could not be done, 2 the\n"
      "command line cannot be understood.\n");
  const std::vector<Command> commands = {
      make_status_command(app),   make_snapshot_command(app), make_dump_command(app),
      make_set_command(app),      make_play_command(app),     make_record_command(app),
      make_coast_command(app),    make_board_command(app),    make_recording_command(app),
      make_doctor_command(app),   make_picture_command(app),  make_radar_command(app),
      make_scenario_command(app), make_exercise_command(app), make_traffic_command(app),
      make_targets_command(app),  make_track_command(app),    make_token_command(app),
      make_user_command(app),     make_audit_command(app),    make_class_command(app),
      make_tls_command(app),      make_cluster_command(app)};
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  }
  return run_parsed(commands);
}

}  // namespace
}  // namespace skerry::client

int main(int argc, char** argv) {
  using namespace skerry::client;
  watch_signals();
  try {
    return run(argc, argv);
  } catch (const ReaderGone&) {
    return kExitOk;
  } catch (const std::exception& error) {
    return report(error.what());
  }
}
