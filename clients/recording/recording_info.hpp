// The contents of a recording, for people and for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/recording/reader.hpp"

namespace skerry::client {

// The result of reading every item.
struct CheckReport {
  std::uint64_t items = 0;
  std::uint64_t chunks_damaged = 0;
  std::optional<recording::RecordingError> damage;  // the last
};
// Error: `progress` gave up.
Result<CheckReport, recording::RecordingError> check_recording(
    const recording::RecordingReader& reader,
    const recording::RecordingReader::Progress& progress = {});

// Lines for a terminal; texts from the file are made printable.
std::string info_text(const recording::RecordingReader& reader,
                      const std::optional<CheckReport>& check);
// One JSON object; times as RFC 3339 and as nanoseconds since 1970.
std::string info_json(const recording::RecordingReader& reader,
                      const std::optional<CheckReport>& check);

}  // namespace skerry::client
