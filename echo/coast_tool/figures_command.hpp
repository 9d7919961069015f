// skerry coast figures: the figures of Ji et al. 2016 on a real coast.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_figures_command(CLI::App& app);

}  // namespace skerry::echo
