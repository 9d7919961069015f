// skerry coast fit: how rough a coast is, and the style that refines it likewise.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_fit_command(CLI::App& app);

}  // namespace skerry::echo
