// The commands of `skerry user`.
#pragma once

#include <vector>

#include "echo/tool_console/command.hpp"

namespace skerry::server {

// add, list, passwd and remove, subcommands of `app`.
std::vector<echo::Command> make_user_commands(CLI::App& app);

}  // namespace skerry::server
