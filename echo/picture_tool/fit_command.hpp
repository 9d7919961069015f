// skerry radar fit: the set that makes our picture most like a recorded one.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_radar_fit_command(CLI::App& app);

}  // namespace skerry::echo
