// Runs a command of skerry-access in this process.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "echo/tool_console/command.hpp"
#include "echo/tool_console/console.hpp"

namespace skerry::server {

struct Ran {
  int code = 0;
  std::string out, err;
};

inline Ran run_tool(const std::function<std::vector<echo::Command>(CLI::App&)>& make_commands,
                    std::vector<std::string> arguments) {
  CLI::App app;
  app.require_subcommand(1);
  const auto commands = make_commands(app);
  std::reverse(arguments.begin(), arguments.end());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Ran ran;
  try {
    app.parse(arguments);
    for (const auto& command : commands) {
      if (command.app->parsed()) ran.code = command.run();
    }
  } catch (const CLI::ParseError&) {
    ran.code = echo::kExitUsage;
  } catch (const std::exception& error) {
    ran.code = echo::report(error.what());
  }
  std::fflush(stdout);
  ran.out = testing::internal::GetCapturedStdout();
  ran.err = testing::internal::GetCapturedStderr();
  return ran;
}

}  // namespace skerry::server
