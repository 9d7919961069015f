#include "server/board/record_frames.hpp"

#include <memory>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

void for_each_block(std::span<const std::uint8_t> bytes, std::span<const std::uint32_t> ends,
                    std::uint64_t first_sequence, std::size_t most_bytes,
                    const std::function<void(const RecordBlock&)>& use) {
  std::uint32_t begin = 0;
  for (std::size_t first = 0; first < ends.size();) {
    std::size_t last = first + 1;
    while (last < ends.size() && ends[last] - begin <= most_bytes) ++last;
    const std::uint32_t end = ends[last - 1];
    use({bytes.subspan(begin, end - begin), first_sequence + first,
         ends.subspan(first, last - first), begin});
    begin = end;
    first = last;
  }
}

EncodedSectorPtr records_frame(std::uint32_t radar, const RecordBlock& block) {
  thread_local wire::ServerMessage message;  // keeps its memory from frame to frame
  wire::BoardRecords& records = *message.mutable_board_records();
  records.set_radar(radar);
  records.set_first_sequence(block.first_sequence);
  records.set_count(block.count());
  records.mutable_records()->assign(block.bytes.begin(), block.bytes.end());
  auto encoded = std::make_shared<EncodedSector>();
  encoded->first_sequence = block.first_sequence;
  append_frame(encoded->bytes, message);
  // `records` is the last field of the message and so ends the frame.
  encoded->begin = static_cast<std::uint32_t>(encoded->bytes.size() - block.bytes.size());
  encoded->spoke_ends.reserve(block.ends.size());
  for (const std::uint32_t end : block.ends) {
    encoded->spoke_ends.push_back(encoded->begin + end - block.begin);
  }
  return encoded;
}

}  // namespace skerry::server
