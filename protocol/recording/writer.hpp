// RecordingWriter: items -> the bytes of a recording (RECORDING.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "protocol/recording/item.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::recording {

enum class Compression : std::uint8_t { none, lz4, zstd };

struct WriterOptions {
  Compression compression = Compression::lz4;
  bool compact = false;                                  // pack spokes by their differences
  std::size_t chunk_bytes = 2 << 20;                     // before compression; 64 KiB .. 64 MiB
  Duration chunk_time = std::chrono::milliseconds(500);  // of recorded time in a chunk, at most
  int zstd_level = 1;                                    // 1 .. 19
};

// Takes the next bytes of the file, all or none.  False: no room, or an error that the sink knows;
// the writer then drops that chunk (it counts what was in it), or attachment, and goes on with the
// next.
using ByteSink = std::function<bool(std::span<const std::uint8_t>)>;

struct WriterCounts {
  std::uint64_t items = 0;           // given
  std::uint64_t spokes = 0;          // given
  std::uint64_t bytes = 0;           // written
  std::uint64_t items_dropped = 0;   // in chunks the sink did not take
  std::uint64_t spokes_dropped = 0;  // the same
};

// Memory: a chunk and its compressed form (compact: the chunk twice more), and some 150 bytes a
// chunk for the index at the end. Nothing is written but whole records, so that a file cut anywhere
// reads up to its last whole chunk.  Thread: one at a time.
class RecordingWriter {
 public:
  // Writes the beginning at once.
  RecordingWriter(ByteSink sink, const WriterOptions& options);
  ~RecordingWriter();  // does not finish()
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;

  // Any order of times is taken; playback is by time.  An item of more than kMaxItem is dropped,
  // and counted.
  void add(const Item& item);
  // The same as an item, from the values.
  void add(const Spoke& spoke);
  void attach(const Attachment& attachment);

  // Ends the chunk at hand, so that what was given can be read.  False if the sink took it not.
  bool flush();
  // flush(), then index, statistics and footer.  Nothing may be added afterwards.
  bool finish();

  WriterCounts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::recording
