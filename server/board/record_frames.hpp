// A batch of records as frames of the native protocol.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "server/core/video_channel.hpp"

namespace skerry::server {

// Whole records: bytes [begin, begin + bytes.size()) of a batch.
struct RecordBlock {
  std::span<const std::uint8_t> bytes;
  std::uint64_t first_sequence = 0;
  std::span<const std::uint32_t> ends;  // of its records, in the batch
  std::uint32_t begin = 0;              // of its first record, in the batch
  std::uint32_t count() const { return static_cast<std::uint32_t>(ends.size()); }
};

// Calls `use` for blocks of at most `most_bytes` (or of one record that is longer), in order.
// `ends`: record k of `bytes` is [ends[k-1], ends[k]).
void for_each_block(std::span<const std::uint8_t> bytes, std::span<const std::uint32_t> ends,
                    std::uint64_t first_sequence, std::size_t most_bytes,
                    const std::function<void(const RecordBlock&)>& use);

// One frame, a ServerMessage with BoardRecords; "spokes" of the sector are its records.
EncodedSectorPtr records_frame(std::uint32_t radar, const RecordBlock& block);

}  // namespace skerry::server
