// Makes a whole recording of a damaged one.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::recording {

struct RepairReport {
  std::uint64_t chunks_kept = 0;     // whose items were copied
  std::uint64_t chunks_damaged = 0;  // of which nothing or not all was
  std::uint64_t bytes_left_out = 0;  // of the old file
  std::uint64_t items = 0;           // of the new one
  bool was_whole = false;            // nothing was wrong with the old one
};

// Writes `to` beside itself first and puts it in place when it is whole.  Error: cannot be read or
// written, nothing in it can be read, `to` exists, or given up by `progress`.
Result<RepairReport, RecordingError> repair(const std::string& from, const std::string& to,
                                            const RecordingReader::Progress& progress = {});

}  // namespace skerry::recording
