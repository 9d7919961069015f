// skerry coast, picture, radar, scenario, token, track and traffic: hand over to the programs
// skerry-coast, skerry-picture, skerry-exercise, skerry-access and skerry-track, which know how
// echoes are made, who may do what or how targets are found.  Clients do not.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clients/cli/command.hpp"

namespace skerry::client {
namespace {

// Replaces this process by the program; gives the exit code if there is none.
int run_tool(const char* program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto beside = self.parent_path() / program;
  if (!unknown) ::execv(beside.c_str(), argv.data());
  if (unknown || errno == ENOENT) ::execvp(program, argv.data());
  if (errno == ENOENT) {
    return report(fmt::format("there is no program {} beside {} nor in PATH", program,
                              unknown ? "skerry" : self.string()),
                  fmt::format("It is built and installed with the server: put {} into {} or into "
                              "a folder of PATH.",
                              program, unknown ? "its folder" : self.parent_path().string()));
  }
  return report(fmt::format("cannot run {}: {}", program, std::strerror(errno)),
                "It must be a program that you may execute.");
}

}  // namespace

Command hand_over(CLI::App& app, const char* name, const std::string& description,
                  const char* program, std::vector<std::string> before) {
  CLI::App* command =
      app.add_subcommand(name, fmt::format("{} (the program {})", description, program));
  command->set_help_flag();  // the program has its own help
  command->prefix_command();
  return {command, [command, program, before] {
            std::vector<std::string> arguments = before;
            for (std::string& each : command->remaining()) arguments.push_back(std::move(each));
            return run_tool(program, std::move(arguments));
          }};
}

Command make_coast_command(CLI::App& app) {
  return hand_over(app, "coast", "Fits, judges and draws coasts", "skerry-coast", {});
}

Command make_picture_command(CLI::App& app) {
  return hand_over(app, "picture", "Judges made pictures by real radars'", "skerry-picture", {});
}

Command make_radar_command(CLI::App& app) {
  return hand_over(app, "radar", "Finds the set of a recorded radar", "skerry-picture", {"radar"});
}

Command make_scenario_command(CLI::App& app) {
  return hand_over(app, "scenario", "Makes, checks, lists and runs exercises", "skerry-exercise",
                   {});
}

Command make_token_command(CLI::App& app) {
  return hand_over(app, "token", "Makes and revokes tokens for skerryd --tokens", "skerry-access",
                   {});
}

Command make_user_command(CLI::App& app) {
  return hand_over(app, "user", "Adds and removes users for skerryd --users", "skerry-access",
                   {"user"});
}

Command make_audit_command(CLI::App& app) {
  return hand_over(app, "audit", "Shows and verifies the file of skerryd --audit", "skerry-access",
                   {"audit"});
}

Command make_tls_command(CLI::App& app) {
  return hand_over(app, "tls", "Makes certificates for skerryd --tls", "skerry-access", {"tls"});
}

Command make_track_command(CLI::App& app) {
  return hand_over(app, "track", "Finds and tracks targets in a recording's video", "skerry-track",
                   {});
}

Command make_traffic_command(CLI::App& app) {
  return hand_over(app, "traffic", "Traffic from and to logs of AIS", "skerry-exercise",
                   {"traffic"});
}

}  // namespace skerry::client
