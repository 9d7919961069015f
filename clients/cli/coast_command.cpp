// skerry coast: hands over to the program skerry-coast, which knows how coasts are made.  Clients
// do not.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "clients/cli/command.hpp"

namespace skerry::client {
namespace {

constexpr const char* kProgram = "skerry-coast";

// Replaces this process by skerry-coast; gives the exit code if there is none.
int run_coast(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), kProgram);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto beside = self.parent_path() / kProgram;
  if (!unknown) ::execv(beside.c_str(), argv.data());
  if (unknown || errno == ENOENT) ::execvp(kProgram, argv.data());
  if (errno == ENOENT) {
    return report(fmt::format("there is no program {} beside {} nor in PATH", kProgram,
                              unknown ? "skerry" : self.string()),
                  fmt::format("It is built and installed with the server: put {} into {} or into "
                              "a folder of PATH.",
                              kProgram, unknown ? "its folder" : self.parent_path().string()));
  }
  return report(fmt::format("cannot run {}: {}", kProgram, std::strerror(errno)),
                "It must be a program that you may execute.");
}

}  // namespace

Command make_coast_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("coast", "Fits, judges and draws coasts (the program skerry-coast)");
  command->set_help_flag();  // skerry-coast has its own help
  command->prefix_command();
  return {command, [command] { return run_coast(command->remaining()); }};
}

}  // namespace skerry::client
