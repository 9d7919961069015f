// Options of a playback.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}
namespace skerry::app {
class Playback;
}

namespace skerry::server {

class PlaybackHost;

struct PlaybackOptions {
  std::string file;  // empty: none, radars run
  double rate = 1.0;
  bool loop = false;
  std::string from;  // protocol/recording/position.hpp; empty: the begin
  bool paused = false;
  bool current_timestamps = false;
};

// --play and what belongs to it; `line` must outlive the parsing.
void add_playback_options(CLI::App& cli, app::Playback& line);

// Absent keys have their defaults.
PlaybackOptions playback_options(const app::Playback& said);

// Opens the file; searching one without an index for its parts is told on standard error.
// Error: std::runtime_error with file and byte, or saying which place or mark there is not.
std::unique_ptr<PlaybackHost> open_playback(const PlaybackOptions& options);

// One line: name, length, radars, and what is wrong with it.
std::string description_of(const PlaybackHost& playback);

}  // namespace skerry::server
