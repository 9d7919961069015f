// `skerry tls`: an authority of one's own and a server's certificate.
#pragma once

#include <vector>

#include "echo/tool_console/command.hpp"

namespace skerry::server {

// init, renew and show, subcommands of `app`.
std::vector<echo::Command> make_tls_commands(CLI::App& app);

}  // namespace skerry::server
