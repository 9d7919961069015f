#include "protocol/wire/frame.hpp"

#include <fmt/format.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/message_lite.h>

#include "protocol/wire/spoke_message.hpp"
#include "protocol/wire/varint.hpp"

namespace skerry {
namespace {

using google::protobuf::io::CodedOutputStream;

struct Length32 {
  std::uint32_t value = 0;
  std::size_t bytes = 0;  // 0: unfinished
  bool malformed = false;
};

// The length at the front of `in`.
Length32 read_length(std::span<const std::uint8_t> in) {
  const Varint length = read_varint(in, kMaxVarint32Octets);
  if (length.octets == 0) return {0, 0, in.size() >= kMaxVarint32Octets};
  return {static_cast<std::uint32_t>(length.value), length.octets, length.value > 0xFFFFFFFF};
}

}  // namespace

void append_frame(Bytes& out, const google::protobuf::MessageLite& message) {
  const auto size = static_cast<std::uint32_t>(message.ByteSizeLong());
  const std::size_t start = out.size();
  out.resize(start + CodedOutputStream::VarintSize32(size) + size);
  std::uint8_t* const body = CodedOutputStream::WriteVarint32ToArray(size, out.data() + start);
  message.SerializeWithCachedSizesToArray(body);
}

void append_spoke_frame(Bytes& out, const Spoke& spoke) {
  thread_local wire::ServerMessage message;
  to_message(spoke, *message.mutable_spoke());
  append_frame(out, message);
}

std::span<const std::uint8_t> frame_body(std::span<const std::uint8_t> frame) {
  const Length32 length = read_length(frame);
  if (length.bytes == 0 || length.malformed || frame.size() - length.bytes != length.value) {
    return {};
  }
  return frame.subspan(length.bytes);
}

void FrameReader::feed(std::span<const std::uint8_t> bytes) {
  if (failure_) return;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(taken_));
  stream_offset_ += taken_;
  taken_ = 0;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<std::span<const std::uint8_t>>, WireError> FrameReader::next() {
  if (failure_) return Failure{*failure_};
  const auto rest = std::span<const std::uint8_t>(buffer_).subspan(taken_);
  const Length32 length = read_length(rest);
  if (length.malformed) {
    failure_ = WireError{WireErrorKind::malformed, stream_offset_ + taken_,
                         "frame: its length is not a 32-bit varint"};
  } else if (length.value > max_frame_) {
    failure_ = WireError{
        WireErrorKind::oversized, stream_offset_ + taken_,
        fmt::format("frame: {} bytes announced, expected at most {}", length.value, max_frame_)};
  }
  if (failure_) {
    buffer_ = {};
    taken_ = 0;
    return Failure{*failure_};
  }
  if (length.bytes == 0 || rest.size() - length.bytes < length.value) {
    return std::optional<std::span<const std::uint8_t>>{};
  }
  taken_ += length.bytes + length.value;
  return std::optional{rest.subspan(length.bytes, length.value)};
}

}  // namespace skerry
