// The commands of skerry-access.
#pragma once

#include <vector>

#include "echo/tool_console/command.hpp"

namespace skerry::server {

// new, list, revoke and rights, subcommands of `app`.
std::vector<echo::Command> make_token_commands(CLI::App& app);

}  // namespace skerry::server
