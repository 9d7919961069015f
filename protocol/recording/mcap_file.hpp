// McapFile: beginning, chunks, attachments and end of an MCAP file of any channels, given to its
// sink.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/recording/chunk_builder.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/summary_builder.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::recording {

// What a file says of a channel.
struct ChannelText {
  std::string topic;
  std::string message_encoding;  // "protobuf", "cdr"
  std::string schema_name;       // a schema is known by it: equal names, equal data
  std::string schema_encoding;   // "protobuf", "ros2msg"
  std::string schema_data;
};

// Memory: that of a compressed chunk, and of the summary.  Thread: one at a time.
class McapFile {
 public:
  // `profile`: "skerry", "ros2" or none.
  McapFile(ByteSink sink, std::string profile, Compression compression, int zstd_level);

  // A new number; nothing when there are too many for 16 bits.
  std::optional<std::uint16_t> add_channel(const ChannelText& text);
  // The Channel record of it.
  std::span<const std::uint8_t> record_of(std::uint16_t channel) const {
    return channels_[channel].record;
  }

  // Each is given to the sink as a whole, with what must stand before it.  False if the sink took
  // it not: then nothing of it is in the file.
  bool begin();
  bool write(const ChunkBuilder& chunk);
  bool attach(const Attachment& attachment);
  // The summary and the footer; nothing may follow.
  bool end();

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
  std::uint16_t schema(const ChannelText& text);
  void start();  // of what the sink gets next
  bool give();
  void add_schemas_of(const ChunkBuilder& chunk, std::vector<std::uint16_t>& added);
  // Appends the chunk's record to out_.  Nothing if it cannot be compressed.
  std::optional<mcap::ChunkIndex> append_chunk(const ChunkBuilder& chunk);

  ByteSink sink_;
  std::string profile_;
  Compression compression_;
  Compressor compressor_;
  Bytes out_;
  bool begun_ = false;
  std::uint64_t offset_ = 0;       // octets the sink has taken
  std::uint32_t crc_ = 0;          // of them
  std::vector<Channel> channels_;  // by number
  std::vector<Schema> schemas_;    // by number less one
  SummaryBuilder summary_;
};

}  // namespace skerry::recording
