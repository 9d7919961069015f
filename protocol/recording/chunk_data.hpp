// ChunkData: a chunk that has been read, checked and decompressed, and where its messages are.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/file_index.hpp"
#include "protocol/recording/input_file.hpp"
#include "protocol/recording/octet_block.hpp"
#include "protocol/recording/topics.hpp"

namespace skerry::recording {

// Immutable.
class ChunkData {
 public:
  struct Entry {
    std::int64_t time = 0;  // ns since 1970
    std::uint32_t offset = 0, size = 0;
    std::uint32_t kind = 0;
  };

  // All channels of ours, or those of `topics` if there are any.
  // Error: it is not there, of an impossible size, or not what its checksum says.
  static Result<std::shared_ptr<const ChunkData>, RecordingError> read(
      const InputFile& file, const ChunkPlace& place, const FileIndex& index,
      const std::set<Topic>& topics = {});

  // In the order of time; of equal times, of the chunk.
  std::span<const Entry> entries() const { return entries_; }
  const ChannelKind& kind_of(const Entry& entry) const { return kinds_[entry.kind]; }
  std::span<const std::uint8_t> bytes_of(const Entry& entry) const {
    return records_.octets().subspan(entry.offset, entry.size);
  }
  // The earliest time of all its messages, skipped ones included; ns since 1970.
  std::int64_t start() const { return start_; }
  std::int64_t end() const { return end_; }
  // Channels that its own Channel records tell of.
  const std::vector<mcap::Channel>& channels() const { return channels_; }
  // How many messages each channel has, those left out too.
  const std::map<std::uint16_t, std::uint64_t>& messages() const { return messages_; }
  std::size_t memory() const {
    return records_.memory() + entries_.capacity() * sizeof(Entry) + sizeof(*this);
  }

 private:
  friend class ChunkParser;
  OctetBlock records_;
  std::vector<ChannelKind> kinds_;
  std::vector<Entry> entries_;
  std::vector<mcap::Channel> channels_;
  std::map<std::uint16_t, std::uint64_t> messages_;
  std::int64_t start_ = 0, end_ = 0;
};

}  // namespace skerry::recording
