// ToolRun: commands of skerry-exercise, run within a test.
#pragma once

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "server/exercise_tool/commands.hpp"

namespace skerry::server {

struct ToolRun {
  int code = 0;
  std::string out, err;
};

// `make` adds the commands to the application and gives them.
template <typename Make>
ToolRun run_tool(std::vector<std::string> arguments, Make&& make) {
  CLI::App app{"", "skerry scenario"};
  app.require_subcommand(1);
  const std::vector<echo::Command> commands = make(app);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  ToolRun result{echo::kExitUsage, {}, {}};
  try {
    app.parse(arguments);
    for (const echo::Command& command : commands) {
      if (command.app->parsed()) result.code = command.run();
    }
  } catch (const CLI::ParseError&) {
    result.code = echo::kExitUsage;
  } catch (const std::exception& error) {
    result.code = echo::kExitFailure;
    result.err = error.what();
  }
  result.out = testing::internal::GetCapturedStdout();
  result.err += testing::internal::GetCapturedStderr();
  return result;
}

}  // namespace skerry::server
