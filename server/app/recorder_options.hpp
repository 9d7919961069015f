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

// What is absent has its default.
RecorderConfig recorder_config(const app::Recorder& said);

}  // namespace skerry::server
