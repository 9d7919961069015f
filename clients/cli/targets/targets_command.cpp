// skerry targets: what the plotter of a view has found, and what a mariner orders of it.
#include "clients/cli/targets/targets_link.hpp"

namespace skerry::client {

Command make_targets_command(CLI::App& app) {
  TargetsApp targets;
  targets.app = app.add_subcommand(
      "targets", "Shows the targets that a view's plotter tracks, and orders the plotter");
  targets.app->require_subcommand(0, 1);
  targets.app->footer(
      "Examples:\n"
      "  skerry targets\n"
      "  skerry targets --radar 1 --by range\n"
      "  skerry targets --json | jq '.targets[] | select(.is_dangerous)'\n"
      "  skerry targets watch --for 600\n"
      "  skerry targets acquire --range 3.2 --bearing 45\n"
      "  skerry targets cancel 3 7\n"
      "  skerry targets rules --cpa 1 --tcpa 12\n"
      "  skerry targets zone 1 --inner 2 --outer 3 --from 315 --to 45 --relative\n"
      "  skerry targets trial --course 90 --speed 12 --delay 5\n"
      "  skerry targets acknowledge\n"
      "Each says more with --help.  Targets have the errors of video and sensors; skerry exercise\n"
      "show tells the truth.  A plotter begins when somebody asks for its targets, and with it\n"
      "end its tracks, rules and zones a minute after the last one has left: keep skerry targets\n"
      "watch running, or a display.\n");
  const Command list = make_list_command(targets);
  std::vector<Command> parts = {make_target_watch_command(targets)};
  for (const auto make : {make_acquire_commands, make_rule_commands, make_alert_commands}) {
    for (const Command& part : make(targets)) parts.push_back(part);
  }
  parts.push_back(make_trial_command(targets));
  return {targets.app, [list, parts] {
            return list.app->get_subcommands().empty() ? list.run() : run_parsed(parts);
          }};
}

}  // namespace skerry::client
