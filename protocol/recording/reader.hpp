// RecordingReader: what is in a recording, and its items in the order of time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::recording {

struct Mark {
  UtcTime time{};
  std::string name;
  std::string kind;  // Event.mark_kind
};

// All that is known without reading every item.
struct Summary {
  std::string file;
  std::uint64_t file_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;  // of the chunks
  UtcTime begin{}, end{};                // of the first and last item; equal if there is none
  std::map<Topic, std::uint64_t> items;  // a spoke of a packed message counts as one
  std::vector<Mark> marks;               // in the order of time; at most 100,000
  std::vector<Attachment> attachments;   // at most kMaxAttachment bytes together
  std::uint64_t chunks = 0;
  std::string compression;  // "none", "lz4", "zstd", as of the first chunk
  bool compact = false;
  // Not finished, or damaged: what was wrong first.  What can be read is offered all the same.
  std::optional<RecordingError> damage;
};

// An item by itself.
struct LastItem {
  UtcTime time{};  // its own
  std::vector<std::uint8_t> bytes;
};

// Reads items from a place in time on.  Of damaged chunks nothing is given; how many were passed
// over is counted.  Memory: the chunks that hold the present time, at most kMaxOpenBytes.
// Thread: one at a time; several cursors of one reader may be used in several threads.
class ItemCursor {
 public:
  static constexpr std::size_t kMaxOpenBytes = 256 << 20;

  ItemCursor(ItemCursor&&) noexcept;
  ItemCursor& operator=(ItemCursor&&) noexcept;
  ~ItemCursor();

  // The next item in the order of time (at equal times, of the file); valid until the next call.
  // nullopt at the end.
  std::optional<Item> next();
  // The first item at `time` or later comes next.  Cost: one chunk read, and by index where the
  // file has one: under 50 ms in 10 GB.
  void seek(UtcTime time);

  std::uint64_t chunks_damaged() const;
  // The damage found last.
  std::optional<RecordingError> damage() const;

  class Impl;  // of the library's own

 private:
  friend class RecordingReader;
  explicit ItemCursor(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Holds the file open.  What others do to it meanwhile (cut, overwrite) is damage, not a crash: it
// is read, not mapped.  Thread: any.
class RecordingReader {
 public:
  // A file without an index (cut short) is searched for its chunks: `progress` (may be empty) gets
  // the share done, 0 .. 1, and may return false to give up.
  // Error: it cannot be read, is no recording, or was given up.
  using Progress = std::function<bool(double)>;
  static Result<RecordingReader, RecordingError> open(const std::string& path,
                                                      const Progress& progress = {});
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  const Summary& summary() const;
  // The first Hello; nothing if there is none that can be read.
  std::optional<wire::Hello> hello() const;

  // A cursor at the begin, over `topics` only, or over all if none is given.
  ItemCursor items(const std::vector<Topic>& topics = {}) const;
  // The last item of the topic before or at `time`: what was in force then.
  // Cost: chunks back to it are looked for by the index.
  std::optional<LastItem> last_before(const Topic& topic, UtcTime time) const;

 private:
  class Impl;
  explicit RecordingReader(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

}  // namespace skerry::recording
