// skerry exercise: what an instructor does, on the command line.
#include "clients/cli/exercise/exercise_link.hpp"

namespace skerry::client {

Command make_exercise_command(CLI::App& app) {
  CLI::App* exercise = app.add_subcommand(
      "exercise", "Leads and watches the exercise of a running server; debriefs a recorded one");
  exercise->require_subcommand(1);
  exercise->footer(
      "Examples:\n"
      "  skerry exercise show\n"
      "  skerry exercise freeze\n"
      "  skerry exercise pace 4\n"
      "  skerry exercise snapshot before\n"
      "  skerry exercise target order Foe --course 045\n"
      "  skerry exercise put Sirius --latitude 60.4 --longitude 5.2\n"
      "  skerry exercise fault Sirius gyro-bias=5 log-lost\n"
      "  skerry exercise text Sirius \"Reduce to 8 knots\"\n"
      "  skerry exercise report watch.mcap -o report.html\n"
      "Each says more with --help.  Weather, rain, own ships' courses, rudder and engine are set "
      "by\n"
      "skerry set --instructor.\n");
  std::vector<Command> commands;
  for (const auto make : {make_look_commands, make_clock_commands, make_keep_commands,
                          make_ship_commands, make_fault_commands}) {
    for (const Command& command : make(*exercise)) commands.push_back(command);
  }
  commands.push_back(hand_over(*exercise, "report", "Debriefs a recorded exercise",
                               "skerry-exercise", {"report"}));
  return {exercise, [commands] { return run_parsed(commands); }};
}

}  // namespace skerry::client
