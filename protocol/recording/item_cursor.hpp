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
#include "protocol/recording/packed_spokes.hpp"
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
  std::uint64_t chunks_damaged() const { return damaged_chunks_.size(); }
  std::optional<RecordingError> damage() const { return damage_; }
  std::uint64_t bytes_damaged() const;  // of the damaged chunks' records

 private:
  struct OpenChunk {
    std::shared_ptr<const ChunkData> data;
    std::uint32_t number = 0;  // in the file
  };
  // An item that may be next: a message of a chunk, or a spoke of a packed message.  What follows
  // it there comes in its place when it has been given.
  struct Source {
    std::int64_t time = 0;
    std::uint32_t chunk_number = 0;
    std::uint32_t offset = 0;          // of the message in the chunk
    std::shared_ptr<OpenChunk> chunk;  // of a packed message: none
    std::size_t entry = 0;
    std::shared_ptr<SpokeUnpacker> packed;
    Topic topic;  // of the packed message
  };

  static bool later(const Source& a, const Source& b);
  void push(Source source);
  void open_chunks();
  void open_next_chunk();
  void note(std::uint32_t chunk_number, RecordingError damage);
  void note(std::uint32_t chunk_number, std::uint32_t offset, const std::string& text);
  // Puts what comes at, or after, the entry into the heap.
  void continue_chunk(std::shared_ptr<OpenChunk> chunk, std::size_t entry);
  void open_packed(const Source& message);
  void continue_packed(Source source);
  void go_on(Source given);

  std::shared_ptr<const OpenRecording> recording_;
  std::set<Topic> topics_;
  std::vector<Source> heap_;     // of the items that may be next
  std::optional<Source> given_;  // whose item the caller has
  std::size_t next_chunk_ = 0;   // in by_start
  std::size_t open_bytes_ = 0;   // of chunks and packed messages
  std::int64_t not_before_ = std::numeric_limits<std::int64_t>::min();
  std::set<std::uint32_t> damaged_chunks_;  // numbers in the file
  std::optional<RecordingError> damage_;
};

}  // namespace skerry::recording
