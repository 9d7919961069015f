// A BoardPort without a board: the test publishes records itself, from its own thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "server/core/board_port.hpp"

namespace skerry::server {

// Every register holds its own address and may be written without effect; records are 64 bytes.
class FakeBoard final : public BoardPort {
 public:
  static constexpr std::size_t kRecordBytes = 64;

  wire::BoardReply access(const wire::BoardAccess& access) override {
    wire::BoardReply reply;
    for (const auto& operation : access.operations()) {
      reply.add_results()->set_value(operation.address());
      if (operation.has_write()) ++writes;
    }
    return reply;
  }
  wire::BoardRecords read_fifo(std::uint32_t count) override {
    wire::BoardRecords given;
    given.set_count(count);
    given.set_first_sequence(1'000'000);
    given.set_records(std::string(count * kRecordBytes, 'f'));
    return given;
  }
  Result<BoardRingLease, std::string> open_ring() override {
    if (!has_memory) return Failure{std::string("no memory left")};
    BoardRingLease given;
    given.reply.set_ring_name("/ring");
    given.lease = lease;
    return given;
  }
  FormatRing& ring(const std::string& format) override {
    return format == kRecordsFormat ? records : signals;
  }
  double bytes_per_second() const override { return 0.0; }

  // A block of so many records, numbered on.
  void publish(std::uint32_t count) {
    records.publish(count, [&] {
      wire::ServerMessage message;
      message.mutable_board_records()->set_first_sequence(published);
      message.mutable_board_records()->set_count(count);
      message.mutable_board_records()->set_records(std::string(count * kRecordBytes, 'r'));
      auto block = std::make_shared<EncodedSector>();
      block->first_sequence = published;
      append_frame(block->bytes, message);
      block->begin = static_cast<std::uint32_t>(block->bytes.size() - count * kRecordBytes);
      for (std::uint32_t i = 1; i <= count; ++i) {
        block->spoke_ends.push_back(block->begin + i * static_cast<std::uint32_t>(kRecordBytes));
      }
      return block;
    });
    published += count;
  }

  FormatRing records{64, 1u << 20}, signals{64, 1u << 20};
  std::uint64_t published = 0;
  int writes = 0;
  bool has_memory = true;
  std::shared_ptr<int> lease = std::make_shared<int>(0);
};

}  // namespace skerry::server
