// Parts that the commands of `skerry-coast` and `skerry-picture` share: how they are made and how
// they end.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace skerry::echo {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailure = 1;  // it could not be done
inline constexpr int kExitUsage = 2;    // the command line cannot be understood

// A subcommand and what it does once it has been parsed; run() returns the exit code.
// Error: run() may throw; main() reports what() and ends with kExitFailure.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

// What report() names the program by, such as "skerry coast".  Called once, before anything else.
void name_program(std::string name);

// Writes the error and what to try to stderr; gives kExitFailure.
int report(const std::string& text, const std::string& advice = {});

}  // namespace skerry::echo
