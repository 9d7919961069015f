// OpenRecording: what a reader and its cursors share.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "protocol/recording/chunk_data.hpp"
#include "protocol/recording/file_index.hpp"
#include "protocol/recording/input_file.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::recording {

// Immutable once its summary is made.  Thread: any.
struct OpenRecording {
  OpenRecording(InputFile the_file, FileIndex the_index);

  Result<std::shared_ptr<const ChunkData>, RecordingError> chunk(
      std::size_t number, const std::set<Topic>& topics) const {
    return ChunkData::read(file, index.chunks[number], index, topics);
  }
  // True if the chunk has a message of one of them; of no topics, always.
  bool has(std::size_t number, const std::set<Topic>& topics) const;
  // How far a chunk's items reach, packed spokes included, which may be later than their message;
  // ns since 1970.
  std::int64_t reach(std::size_t number) const;
  // The first of by_start that may, or whose successors may, hold something of `time` or later.
  std::size_t first_reaching(std::int64_t time) const;

  InputFile file;
  FileIndex index;
  Summary summary;
  std::vector<std::uint32_t> by_start;  // chunks in the order of their first message
  std::vector<std::int64_t> reaches;    // how far those of by_start up to each reach
  std::int64_t packed_span = 0;         // ns; 0 without packed spokes
};

// Makes the summary.  Error: given up.
std::optional<RecordingError> summarise(OpenRecording& recording,
                                        const RecordingReader::Progress& progress);
// Opens as RecordingReader::open() does.
Result<std::shared_ptr<const OpenRecording>, RecordingError> open_recording(
    const std::string& path, const RecordingReader::Progress& progress);

}  // namespace skerry::recording
