// Making recordings of recordings: a part of one, or several together.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::client {

struct EditReport {
  std::uint64_t items = 0;
  std::uint64_t spokes = 0;
  std::uint64_t chunks_damaged = 0;  // of the sources, passed over
  std::vector<std::string> notes;    // what the user should know, a sentence each
};

// Items from `from` until before `to`, as they are, byte by byte.  Before them: Hello, what was in
// force at `from` (settings, own ship, world) with that time, and the inputs of the exercise since
// its beginning, without which the others mean nothing.  Attachments go along.
// Error: nothing lies there, the file cannot be read, or `progress` gave up.
Result<EditReport, recording::RecordingError> cut_recording(
    const recording::RecordingReader& source, UtcTime from, UtcTime to,
    recording::RecordingWriter& writer, const recording::RecordingReader::Progress& progress = {});

// All items of all sources in the order of time.  Radars of the same number, name and shape are the
// same radar if the recordings follow each other; where they overlap, or differ, the later source's
// gets the next free number.  Inputs that several sources repeat, as files of one series do, are
// kept once; inputs of another exercise than the first are left out.
// Requires at least one source.  Error: `progress` gave up.
Result<EditReport, recording::RecordingError> join_recordings(
    std::span<const recording::RecordingReader> sources, recording::RecordingWriter& writer,
    const recording::RecordingReader::Progress& progress = {});

}  // namespace skerry::client
