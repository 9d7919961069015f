// skerry picture judge: a simulation's picture by a real one's.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_picture_judge_command(CLI::App& app);

}  // namespace skerry::echo
