// skerry picture sheet: real pictures beside ours, as one image.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_picture_sheet_command(CLI::App& app);

}  // namespace skerry::echo
