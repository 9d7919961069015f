// The commands on the file of who did what.
#pragma once

#include <vector>

#include "echo/tool_console/command.hpp"

namespace skerry::server {

// verify and show, subcommands of `app`.
std::vector<echo::Command> make_audit_commands(CLI::App& app);

}  // namespace skerry::server
