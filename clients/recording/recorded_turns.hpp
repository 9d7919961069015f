// RecordedTurns: the turns of one radar's view in a recording, with what was in force then.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "protocol/picture/ppi_picture.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/video/scan.hpp"

namespace skerry::client {

struct RecordedTurn {
  std::uint64_t number = 0;  // 1: the first that lies in the part asked for
  Scan scan;
  PpiLabels labels;
};

// Which spokes are wanted.  `to` is not in it.
struct RecordedPart {
  std::uint32_t radar = 0;
  std::uint32_t view = 0;
  std::optional<UtcTime> from, to;
};

// Counts of the parts skipped so far.
struct NotRead {
  std::uint64_t spokes = 0;  // items that are none
  std::uint64_t chunks = 0;  // damaged, in part or all; also of those looked at behind the part

  std::string text() const;  // "3 spokes and 1 chunk could not be read whole"; empty: nothing was
};

// Spokes have the times of their items.
// Thread: one at a time; the reader outlives it.
class RecordedTurns {
 public:
  // `progress` gets the share read and may give up: then there are no more turns.
  RecordedTurns(const recording::RecordingReader& reader, const RecordedPart& part,
                const recording::RecordingReader::Progress& progress = {});

  // The next one, whole or not; the last may have just begun.
  std::optional<RecordedTurn> next();

  NotRead not_read() const { return {refused_, cursor_.chunks_damaged()}; }
  bool given_up() const { return given_up_; }

 private:
  std::optional<Scan> read_one();

  const recording::RecordingReader& reader_;
  RecordedPart part_;
  recording::RecordingReader::Progress progress_;
  recording::ItemCursor cursor_;
  ScanAssembler assembler_;
  PpiLabels labels_;
  std::uint64_t number_ = 0, items_ = 0, refused_ = 0;
  bool ended_ = false, given_up_ = false;
};

struct SpokesRead {
  std::uint64_t spokes = 0;
  NotRead not_read;
};

// Calls `line` with every spoke of that part, at the time of its item.  Error: `progress` gave up,
// or there are none.
Result<SpokesRead, recording::RecordingError> each_spoke(
    const recording::RecordingReader& reader, const RecordedPart& part,
    const std::function<void(Spoke)>& line,
    const recording::RecordingReader::Progress& progress = {});

// Why `part` has nothing: which radars and views have spokes.
std::string no_spokes_text(const recording::Summary& summary, const RecordedPart& part);

}  // namespace skerry::client
