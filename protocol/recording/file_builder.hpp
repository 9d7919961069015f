// FileBuilder: beginning, chunks, attachments, index and end of a recording, given to its sink.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/chunk_builder.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/recording/summary_builder.hpp"
#include "protocol/recording/topics.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::recording {

inline constexpr char kProfile[] = "skerry";
// The attachment that holds the Contents of a finished file.
inline constexpr char kContentsName[] = "skerry.contents";
inline constexpr char kContentsType[] = "application/x-protobuf";
// Marks in the Contents, and in a reader's summary: no more are kept.
inline constexpr std::size_t kMaxMarks = 100'000;

// Memory: that of a compressed chunk, and of the summary.  Thread: one at a time.
class FileBuilder {
 public:
  FileBuilder(ByteSink sink, Compression compression, int zstd_level);

  // A number of its own for each; nothing when there are too many for 16 bits.
  std::optional<std::uint16_t> channel(const ChannelKind& kind);
  // The Channel record of it.
  std::span<const std::uint8_t> record_of(std::uint16_t channel) const {
    return channels_[channel].record;
  }

  // Each is given to the sink as a whole, with what must stand before it.  False if the sink took
  // it not: then nothing of it is in the file.
  bool begin();
  bool write(const ChunkBuilder& chunk);
  bool attach(const Attachment& attachment);
  bool finish();

  std::uint64_t bytes() const { return offset_; }

 private:
  struct Channel {
    std::uint16_t schema = 0;
    Bytes record;
  };
  struct Schema {
    std::string name;
    Bytes record;
  };
  std::uint16_t schema(const ChannelKind& kind);
  void start();  // of what the sink gets next
  bool give();
  void add_schemas_of(const ChunkBuilder& chunk, std::vector<std::uint16_t>& added);
  // Appends the chunk's record to out_.  Nothing if it cannot be compressed.
  std::optional<mcap::ChunkIndex> append_chunk(const ChunkBuilder& chunk);
  void count(const ChunkBuilder& chunk);

  ByteSink sink_;
  Compression compression_;
  Compressor compressor_;
  Bytes out_;
  bool begun_ = false;
  std::uint64_t offset_ = 0;  // octets the sink has taken
  std::uint32_t crc_ = 0;     // of them
  std::map<ChannelKind, std::uint16_t> numbers_;
  std::vector<Channel> channels_;  // by number
  std::vector<Schema> schemas_;    // by number less one
  SummaryBuilder summary_;
  std::map<Topic, std::uint64_t> items_;
  Contents contents_;
};

}  // namespace skerry::recording
