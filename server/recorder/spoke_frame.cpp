#include "server/recorder/spoke_frame.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {
namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

constexpr std::uint32_t tag(int field, WireFormatLite::WireType type) {
  return WireFormatLite::MakeTag(field, type);
}
constexpr std::uint32_t kSpokeTag =
    tag(wire::ServerMessage::kSpokeFieldNumber, WireFormatLite::WIRETYPE_LENGTH_DELIMITED);
constexpr std::uint32_t kSequenceTag =
    tag(wire::Spoke::kSequenceFieldNumber, WireFormatLite::WIRETYPE_VARINT);
constexpr std::uint32_t kUtcTag =
    tag(wire::Spoke::kUtcNsFieldNumber, WireFormatLite::WIRETYPE_FIXED64);

constexpr std::uint32_t kScenarioTag =
    tag(wire::Spoke::kScenarioNsFieldNumber, WireFormatLite::WIRETYPE_FIXED64);

}  // namespace

std::optional<FramedSpoke> framed_spoke(std::span<const std::uint8_t> frame) {
  const std::span<const std::uint8_t> body = frame_body(frame);
  CodedInputStream message(body.data(), static_cast<int>(body.size()));
  std::uint32_t size = 0;
  if (message.ReadTag() != kSpokeTag || !message.ReadVarint32(&size)) return std::nullopt;
  const auto begin = static_cast<std::size_t>(message.CurrentPosition());
  if (size > body.size() - begin) return std::nullopt;
  FramedSpoke out{.bytes = body.subspan(begin, size)};
  // Fields come in their order, so that the cells, after all three, are not read.
  CodedInputStream spoke(out.bytes.data(), static_cast<int>(size));
  std::uint64_t utc_ns = 0, scenario_ns = 0;
  while (const std::uint32_t next = spoke.ReadTag()) {
    if (next == kSequenceTag) {
      if (!spoke.ReadVarint64(&out.sequence)) return std::nullopt;
    } else if (next == kUtcTag) {
      if (!spoke.ReadLittleEndian64(&utc_ns)) return std::nullopt;
    } else if (next == kScenarioTag) {
      if (!spoke.ReadLittleEndian64(&scenario_ns)) return std::nullopt;
      break;
    } else if (WireFormatLite::GetTagFieldNumber(next) > wire::Spoke::kScenarioNsFieldNumber) {
      break;
    } else if (!WireFormatLite::SkipField(&spoke, next)) {
      return std::nullopt;
    }
  }
  out.utc = UtcTime(Duration(static_cast<std::int64_t>(utc_ns)));
  out.scenario = ScenarioTime(Duration(static_cast<std::int64_t>(scenario_ns)));
  return out;
}

}  // namespace skerry::server
