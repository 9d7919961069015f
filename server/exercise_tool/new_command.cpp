#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "echo/tool_console/console.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/exercise_tool/land_check.hpp"
#include "server/exercise_tool/new_scenario.hpp"

namespace skerry::server {
namespace {

struct NewOptions {
  std::string file;
  std::string name = "My exercise";
  std::string scheme = "open";
  double lat = 57.3, lon = 3.5;
  bool force = false;
};

int make_new(const NewOptions& options) {
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.file, ignored)) {
    return echo::report(fmt::format("{} is there already", options.file),
                        "Name another file, or give --force to write over it.");
  }
  const auto text = new_scenario(options.scheme, options.name, {options.lat, options.lon});
  // It is checked before it is written.
  const scenario::Scenario scenario = exercise_scenario(*text, options.file);
  const auto chart = open_charts({}, "");
  const auto complaints = land_complaints(scenario, *chart, length_in_minutes(scenario));
  if (!complaints.empty() && !options.force) {
    std::string all;
    for (const std::string& complaint : complaints) all += "\n  " + complaint;
    return echo::report("there is not enough water for it:" + all,
                        "Choose another --lat and --lon, or give --force.");
  }
  echo::write_file(options.file, *text);
  echo::write_out(
      fmt::format("{}: written. Next:\n  skerry scenario check {}\n"
                  "  skerry scenario run {} --fast --checks\n",
                  options.file, options.file, options.file));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_new_command(CLI::App& app) {
  auto options = std::make_shared<NewOptions>();
  CLI::App* command = app.add_subcommand("new", "Writes a scenario to begin with, with comments");
  command->add_option("FILE", options->file, "the file to write")->required();
  command->add_option("--name", options->name, "the scenario's name")->capture_default_str();
  command->add_option("--lat", options->lat, "where it is, degrees north")
      ->check(CLI::Range(-80.0, 80.0))
      ->capture_default_str();
  command->add_option("--lon", options->lon, "where it is, degrees east")
      ->check(CLI::Range(-180.0, 180.0))
      ->capture_default_str();
  command->add_option("--template", options->scheme, "what it begins with")
      ->check(CLI::IsMember(scenario_templates()))
      ->capture_default_str();
  command->add_flag("--force", options->force, "write over a file, and where land is in the way");
  command->footer(
      "Examples:\n"
      "  skerry scenario new mine.yaml\n"
      "  skerry scenario new mine.yaml --name \"Off Hanstholm\" --lat 57.3 --lon 8.0 --template "
      "fairway\n");
  return {command, [options] { return make_new(*options); }};
}

}  // namespace skerry::server
