// skerry coast judge: every method against the real coast it was not shown.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_judge_command(CLI::App& app);

}  // namespace skerry::echo
