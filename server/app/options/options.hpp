// Options of skerryd: the command line overrides the configuration file, which overrides the
// defaults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/app/options/fleet_options.hpp"
#include "server/app/options/playback_options.hpp"
#include "server/app/options/relay_options.hpp"
#include "server/live/live_source.hpp"
#include "server/net/common/net_config.hpp"
#include "server/recorder/recorder_config.hpp"

namespace skerry::server {

struct Options {
  std::string scenario;  // file; empty: the built-in one
  // Files and folders, each over those after it (charts.hpp); none: the finest GSHHG installed.
  std::vector<std::string> charts;
  std::string elevation;  // file or folder; empty: the relief is synthetic
  NetConfig net;
  std::vector<LiveSource> live;  // real radars, in place of simulated ones
  RecorderConfig recorder;
  PlaybackOptions playback;  // its file is empty where radars run
  RelayOptions relay;
  FleetOptions fleet;
  std::size_t workers = 0;                   // helping threads per radar
  std::size_t board_ring_bytes = 16u << 20;  // of each board's ring in shared memory
  std::string log_level = "info";
  std::string audit;                   // file of who did what; empty: none
  std::uint64_t audit_roll_bytes = 0;  // size at which it is moved away; 0: never
  std::string state;                   // folder of what the server keeps; empty: none
  bool print_ports = false;  // one line "tcp PORT http PORT" on standard output once listening
  bool check_only = false;   // read everything, start nothing
  std::string verify;        // a recording whose video is made again; empty: none
  std::string verify_video;  // where that goes; empty: it is only compared
};

// Reads the command line and the files it names.  Nothing is returned when --help or --version was
// asked for and printed.
// Error: ConfigError or std::runtime_error for what is wrong in them; exit code 2.
std::optional<Options> read_options(int argc, const char* const* argv);

}  // namespace skerry::server
