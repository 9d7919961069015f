// BoardRequests: one native client's dealings with interface boards.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "protocol/wire/radar.pb.h"
#include "server/net/common/net_context.hpp"

namespace skerry::server {

// Answers requests, holds the client's place in the stream of records it asked for, and the lease
// of the shared ring, which ends with the connection.  Whether the client may is not asked here.
// Thread: net-0.
class BoardRequests {
 public:
  static constexpr int kMaxOperations = 256;       // of a BoardAccess
  static constexpr std::uint32_t kMaxSweeps = 64;  // of a BoardFifo

  // Both must outlive it; `reader` is told of new records.
  BoardRequests(NetContext& context, FeedReader& reader) : context_(context), reader_(reader) {}
  BoardRequests(const BoardRequests&) = delete;
  BoardRequests& operator=(const BoardRequests&) = delete;

  // `first`, if there is one, goes to the client right before the reply (without a request number).
  struct Answer {
    std::optional<wire::ServerMessage> first;
    wire::Reply reply;
  };
  Answer access(const wire::BoardAccess& access);
  Answer stream(const wire::BoardStream& stream);
  Answer read_fifo(const wire::BoardFifo& fifo);
  Answer open_ring(const wire::BoardRing& ring);

  // Ends stream and lease; call it before the destructor.
  void leave();
  bool streams() const { return feed_ != nullptr; }
  // Bytes that may wait in the kernel: 100 ms of the stream, 0 without one.
  std::size_t send_buffer() const;

  // The next block of records; nullptr if none is there yet, or without a stream.
  EncodedSectorPtr take() { return feed_ == nullptr ? nullptr : feed_->ring().take(cursor_); }
  // Records that were overwritten before they were taken, of all streams so far.
  std::uint64_t lost() const { return lost_before_ + cursor_.spokes_lost; }

 private:
  void end_stream();

  NetContext& context_;
  FeedReader& reader_;
  SpokeFeed* feed_ = nullptr;
  std::uint32_t radar_ = 0;  // of feed_
  Cursor cursor_;
  std::uint64_t lost_before_ = 0;
  std::shared_ptr<void> lease_;
};

}  // namespace skerry::server
