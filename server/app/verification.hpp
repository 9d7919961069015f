// Verification: makes the video of a recorded exercise again.
#pragma once

#include <cstddef>
#include <string>

#include "server/app/exercise_files.hpp"

namespace skerry::server {

struct VerifyOptions {
  std::string file;    // the recording
  std::string video;   // where the video made again goes; empty: nowhere
  ChartFiles instead;  // charts, where they do not lie where they did
  std::size_t workers = 0;
};

// Compares what is made again with what the recording has of it (spokes byte by byte, or
// checkpoints) and says so on standard output, with progress on a terminal's standard error.
// Returns the exit code: 0 if all is identical (or there was nothing to compare and the video was
// written), 1 if not.  Error: std::runtime_error naming file and byte, or what is missing.
int verify(const VerifyOptions& options);

}  // namespace skerry::server
