// SummaryBuilder: what a file's end says of all before it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/mcap_records.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::recording {

// Told of what is in the file, it makes the rest: DataEnd, summary, footer and magic.
// Memory: about 150 octets a chunk.  Thread: one at a time.
class SummaryBuilder {
 public:
  // Adds a record that is in the file.
  void add_schema(std::uint16_t id, Bytes record);
  void add_channel(std::uint16_t id, Bytes record);
  void add_chunk(const mcap::ChunkIndex& index,
                 const std::map<std::uint16_t, std::uint64_t>& channel_messages);
  void add_attachment(const mcap::AttachmentIndex& index);

  bool has_schema(std::uint16_t id) const { return schemas_.contains(id); }
  // `offset`: how long the file is; `crc` of all of it.
  Bytes end(std::uint64_t offset, std::uint32_t crc) const;

 private:
  mcap::Statistics statistics() const;

  std::map<std::uint16_t, Bytes> schemas_;
  std::map<std::uint16_t, Bytes> channels_;
  std::map<std::uint16_t, std::uint64_t> channel_messages_;
  Bytes chunk_indexes_;
  Bytes attachment_indexes_;
  std::uint32_t chunks_ = 0, attachments_ = 0;
  std::uint64_t start_ = 0, end_ = 0;  // ns, of all chunks
};

}  // namespace skerry::recording
