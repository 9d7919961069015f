// Frames: messages on a byte stream (TCP, WebSocket), each after its length as a varint.  These are
// protobuf's own delimited streams, so every protobuf library reads and writes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/wire_error.hpp"

namespace google::protobuf {
class MessageLite;
}

namespace skerry {

// Longest body, in bytes.  A client has little to say, so a server that believed a longer length
// would only hold memory for a stranger; the longest spoke takes 4.3 kB, a Status with hundreds of
// clients some 100 kB.
inline constexpr std::size_t kMaxClientFrame = 4096;
inline constexpr std::size_t kMaxServerFrame = 1 << 20;

// Appends `message` as one frame.  Requires a message below 2 GiB (protobuf's own limit).
void append_frame(Bytes& out, const google::protobuf::MessageLite& message);

// Appends a ServerMessage that holds `spoke`, as one frame.  Requirements as to_message().  Does
// not allocate but for `out`: each thread keeps one message.
void append_spoke_frame(Bytes& out, const Spoke& spoke);

// The body of one whole frame made by append_frame(); empty if `frame` is not one.
std::span<const std::uint8_t> frame_body(std::span<const std::uint8_t> frame);

// Cuts a stream into frames, however the stream was cut into reads.
// Use: after each feed(), call next() until it gives nothing; then at most one unfinished frame is
// held, so that memory stays below max_frame + 5 bytes + one feed.
// Thread: one at a time.
class FrameReader {
 public:
  explicit FrameReader(std::size_t max_frame) : max_frame_(max_frame) {}

  void feed(std::span<const std::uint8_t> bytes);

  // The body of the next whole frame, valid until the next feed() or next(); nothing if more bytes
  // are needed.
  // Error: oversized for a length above max_frame, malformed for a length that is no 32-bit varint.
  // It stays: a stream that lost its framing cannot be trusted again, so close it.  The offset
  // counts from the first byte ever fed.
  Result<std::optional<std::span<const std::uint8_t>>, WireError> next();

  // Bytes held: fed, but not yet given out.
  std::size_t pending() const { return buffer_.size() - taken_; }

 private:
  std::size_t max_frame_;
  Bytes buffer_;
  std::size_t taken_ = 0;            // bytes of buffer_ already given out
  std::uint64_t stream_offset_ = 0;  // of buffer_[0]
  std::optional<WireError> failure_;
};

}  // namespace skerry
