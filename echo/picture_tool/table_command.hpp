// skerry picture table: every capture of a folder beside ours.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::echo {

Command make_picture_table_command(CLI::App& app);

}  // namespace skerry::echo
