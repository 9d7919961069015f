#include <fmt/format.h>

#include <memory>
#include <vector>

#include "echo/tool_console/console.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/exercise_tool/land_check.hpp"

namespace skerry::server {
namespace {

struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> charts;
  bool force = false;
};

std::string summary_of(const scenario::Scenario& scenario) {
  int ships = 0, radars = 0;
  for (const auto& target : scenario.targets()) {
    if (target.kind() == scenario::Target::ship) ++ships;
  }
  for (const auto& own : scenario.own_ships()) radars += own.radars_size();
  return fmt::format(
      "{}: {} own ships with {} radars, {} ships, {} marks and boats, {} events, "
      "{} checks, {:.0f} min",
      scenario.name(), scenario.own_ships_size(), radars, ships, scenario.targets_size() - ships,
      scenario.events_size(), scenario.exercise().checks_size(), length_in_minutes(scenario));
}

// True if it is good.
bool check_file(const std::string& file, const CheckOptions& options,
                const echo::ChartSource& chart) {
  ScenarioFile opened;
  try {
    opened = open_scenario(file);
  } catch (const ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return false;
  }
  const auto complaints =
      land_complaints(opened.scenario, chart, length_in_minutes(opened.scenario));
  for (const std::string& complaint : complaints) {
    fmt::print(stderr, "{}: {}{}\n", file, options.force ? "warning: " : "", complaint);
  }
  if (!complaints.empty() && !options.force) {
    fmt::print(stderr, "{}: {} on land; --force makes warnings of these\n", file,
               complaints.size());
    return false;
  }
  echo::write_out(fmt::format("{}: good. {}\n", file, summary_of(opened.scenario)));
  return true;
}

int check_files(const CheckOptions& options) {
  const auto chart = open_charts(options.charts, "");
  int bad = 0;
  for (const std::string& file : options.files) bad += check_file(file, options, *chart) ? 0 : 1;
  return bad == 0 ? echo::kExitOk : echo::kExitFailure;
}

}  // namespace

echo::Command make_check_command(CLI::App& app) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Says all that is wrong with scenarios, and sums up those that are good");
  command->add_option("FILE", options->files, "scenario files, or names of shipped exercises")
      ->required();
  command->add_option("--chart", options->charts, "charts over the built-in shoreline")->take_all();
  command->add_flag("--force", options->force, "ships on land are warnings");
  command->footer(
      "Besides what the server checks, nobody may begin on land, have a leg over land, or come on\n"
      "land within the exercise when nobody touches anything.  Exit codes: 0 all are good, 1 one\n"
      "is not, 2 the command line cannot be understood.\n"
      "Examples:\n"
      "  skerry scenario check mine.yaml\n"
      "  skerry scenario check crossing fog\n");
  return {command, [options] { return check_files(*options); }};
}

}  // namespace skerry::server
