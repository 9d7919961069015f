#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "echo/tool_console/console.hpp"
#include "server/app/exercise_files.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/world/shipped_exercises.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, const std::string& name) {
  try {
    const scenario::Scenario scenario = open_scenario(file.string()).scenario;
    return fmt::format("{:<12} {:>3.0f} min  {}\n{:<21}{}\n", name, length_in_minutes(scenario),
                       scenario.name(), "",
                       scenario.has_exercise() ? scenario.exercise().goal() : "(no exercise)");
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    return fmt::format("{:<12}      is no good scenario: {}\n", name,
                       text.substr(0, text.find('\n')));
  }
}

int list(const std::string& folder) {
  std::string out;
  for (const fs::path& file : scenario_files(exercises_folder())) {
    out += line_of(file, file.stem().string());
  }
  if (!folder.empty()) {
    if (!fs::is_directory(folder)) {
      return echo::report(fmt::format("{} is no folder", folder));
    }
    for (const fs::path& file : scenario_files(folder)) out += line_of(file, file.string());
  }
  if (out.empty()) {
    return echo::report(fmt::format("there are no exercises in {}", exercises_folder().string()),
                        "They are installed with the server.");
  }
  echo::write_out(out);
  return echo::kExitOk;
}

}  // namespace

echo::Command make_list_command(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("list", "Lists the shipped exercises, and those in a folder");
  command->add_option("DIR", *folder, "a folder with scenario files");
  command->footer(
      "Example:\n"
      "  skerry scenario list\n"
      "A shipped exercise is run by its name: skerryd --scenario crossing\n");
  return {command, [folder] { return list(*folder); }};
}

}  // namespace skerry::server
