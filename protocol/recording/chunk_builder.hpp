// ChunkBuilder: the records of the chunk that a writer is filling, and what its index will say.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/item.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry::recording {

// The content of a chunk, of use only once it is written.
struct ChunkContents {
  std::map<Topic, std::uint64_t> items;  // a packed spoke counts as one
  std::vector<Contents::Mark> marks;
  std::map<std::uint16_t, std::uint64_t> channel_messages;
  std::uint64_t all_items = 0;
  std::uint64_t spokes = 0;
  std::uint64_t last_time = 0;  // of the last item, of packed spokes too; ns
};

// Every chunk holds the Channel records of all its messages, so that it can be read by itself.
// Memory: kept from chunk to chunk.  Thread: one at a time.
class ChunkBuilder {
 public:
  // Before the first message of a channel in this chunk; does nothing the second time.
  // `record` is its Channel record.
  void use_channel(std::uint16_t channel, std::span<const std::uint8_t> record);
  // Room for a message of `size` octets, which the caller fills before anything else is called.
  std::span<std::uint8_t> add_message(std::uint16_t channel, std::uint32_t sequence,
                                      std::uint64_t time_ns, std::size_t size);
  // `count` items of the topic, the last of them at that time.
  void count(const Topic& topic, std::uint64_t last_time_ns, std::uint64_t count = 1);
  // A MARK.
  void mark(std::uint64_t time_ns, const Event& event);

  bool empty() const { return messages_ == 0; }
  std::span<const std::uint8_t> records() const { return records_; }
  std::uint64_t start() const { return start_; }  // ns; of the messages
  std::uint64_t end() const { return end_; }
  const ChunkContents& contents() const { return contents_; }
  // Appends the MessageIndex records, the first of which is at `offset` of the file; where they
  // are.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> append_indexes(Bytes& out,
                                                                      std::uint64_t offset) const;
  void clear();

 private:
  Bytes records_;
  std::vector<Bytes> index_;  // by channel: times and offsets, 16 octets each
  std::uint64_t messages_ = 0;
  std::uint64_t start_ = 0, end_ = 0;
  ChunkContents contents_;
};

}  // namespace skerry::recording
