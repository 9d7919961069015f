// The commands of skerry-track.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::server {

// `skerry track FILE`: the application itself, if none of its subcommands is given.
echo::Command make_track_command(CLI::App& app);
echo::Command make_recorded_command(CLI::App& app);
echo::Command make_truth_command(CLI::App& app);
echo::Command make_judge_command(CLI::App& app);

}  // namespace skerry::server
