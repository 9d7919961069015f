// How skerryd records.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/recorder/recorder_config.hpp"

namespace CLI {
class App;
}
namespace skerry::app {
class Recorder;
}

namespace skerry::server {

// As given on the command line; what is absent is the configuration file's, or the default.
struct RecorderOptions {
  std::optional<std::string> folder;
  bool record = false, record_all_views = false;
  std::optional<std::string> compression;  // none, lz4, zstd
  bool compact = false;
  std::optional<std::uint32_t> roll_mib, roll_minutes, keep_gib, keep_hours, reserve_mib;
  std::optional<std::string> fsync;  // none, file, chunk
};

// --record and what belongs to it; `options` must outlive the parsing.
void add_recorder_options(CLI::App& cli, RecorderOptions& options);

// The command line over the `recorder` section of a configuration file.
RecorderConfig recorder_config(const app::Recorder& file, const RecorderOptions& options);

}  // namespace skerry::server
