// The commands of skerry-exercise.
#pragma once

#include "echo/tool_console/command.hpp"

namespace skerry::server {

echo::Command make_new_command(CLI::App& app);
echo::Command make_check_command(CLI::App& app);
echo::Command make_list_command(CLI::App& app);
echo::Command make_run_command(CLI::App& app);
echo::Command make_report_command(CLI::App& app);

// Of the command `traffic`.
CLI::App& add_traffic_commands(CLI::App& app);
echo::Command make_traffic_import_command(CLI::App& app);
echo::Command make_traffic_export_command(CLI::App& app);

}  // namespace skerry::server
