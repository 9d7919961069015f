// How skerryd records.
#pragma once

#include "server/recorder/recorder_config.hpp"

namespace CLI {
class App;
}
namespace skerry::app {
class Recorder;
}

namespace skerry::server {

// --record and what belongs to it; `line` must outlive the parsing.
void add_recorder_options(CLI::App& cli, app::Recorder& line);

// Absent keys have their defaults.
RecorderConfig recorder_config(const app::Recorder& said);

}  // namespace skerry::server
