// ItemCursor::Impl: merges the items of the chunks that overlap the present time.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "protocol/recording/open_recording.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::recording {

// Chunks are opened as their time comes, and closed when their last item has been given.  Where
// more would be open than kMaxOpenBytes, the next waits for others to end, and its first items come
// late.  Thread: one at a time.
class ItemCursor::Impl {
 public:
  Impl(std::shared_ptr<const OpenRecording> recording, std::set<Topic> topics);

  std::optional<Item> next();
  void seek(std::int64_t time_ns);
  std::uint64_t chunks_damaged() const { return damaged_; }
  std::optional<RecordingError> damage() const { return damage_; }

 private:
  struct OpenChunk {
    std::shared_ptr<const ChunkData> data;
    std::uint32_t number = 0;  // in the file
    std::size_t sources = 0;   // that still read it
  };
  // An item that may be next, and where what follows it is.
  struct Source {
    std::int64_t time = 0;
    std::uint32_t offset = 0;
    std::size_t entry = 0;
    std::shared_ptr<OpenChunk> chunk;
  };

  static bool later(const Source& a, const Source& b);
  void push(Source source);
  void release(const std::shared_ptr<OpenChunk>& chunk);
  void open_chunks();
  void open_next_chunk();
  void continue_chunk(const std::shared_ptr<OpenChunk>& chunk, std::size_t entry);

  std::shared_ptr<const OpenRecording> recording_;
  std::set<Topic> topics_;
  std::vector<Source> heap_;     // of the items that may be next
  std::optional<Source> given_;  // whose item the caller has
  std::size_t next_chunk_ = 0;   // in by_start
  std::size_t open_bytes_ = 0;
  std::int64_t not_before_ = std::numeric_limits<std::int64_t>::min();
  std::uint64_t damaged_ = 0;
  std::optional<RecordingError> damage_;
};

}  // namespace skerry::recording
