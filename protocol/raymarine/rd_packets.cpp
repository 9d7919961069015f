#include "protocol/raymarine/rd_packets.hpp"

#include <fmt/format.h>

#include "protocol/raymarine/run_length.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::raymarine {
namespace {

constexpr std::size_t kFrameHeaderBytes = 32, kSpokeHeaderBytes = 40, kDataHeaderBytes = 12;
constexpr std::uint32_t kSpokeHeader = 1, kExtraHeader = 2, kData = 3, kLastOfFrame = 0x80000000;
constexpr std::uint32_t kFourBits = 1;  // of a spoke header; 3 with HD scanners

// A part of a frame: its kind, how long it tells it is, and what stands between.
struct Part {
  std::uint32_t kind = 0;
  std::span<const std::uint8_t> body;
};
Result<Part, WireError> take_part(ByteReader& reader) {
  constexpr std::size_t kPartHeaderBytes = 8;
  const std::size_t at = reader.offset();
  Part part;
  part.kind = reader.little_endian<std::uint32_t>();
  const auto length = reader.little_endian<std::uint32_t>();
  if (reader.truncated() || length < kPartHeaderBytes ||
      length - kPartHeaderBytes > reader.left()) {
    return failure(
        WireErrorKind::truncated, at,
        fmt::format("a part of {} bytes where the datagram has {} left", length, reader.left()));
  }
  part.body = reader.take(length - kPartHeaderBytes);
  return part;
}

Result<RdSpoke, WireError> take_spoke(ByteReader& reader) {
  const std::size_t at = reader.offset();
  auto header = take_part(reader);
  if (!header) return Failure<WireError>{header.error()};
  if (header->kind != kSpokeHeader || header->body.size() + 8 != kSpokeHeaderBytes) {
    return failure(WireErrorKind::malformed, at,
                   fmt::format("part {} of {} bytes where a spoke's header was expected",
                               header->kind, header->body.size() + 8));
  }
  ByteReader fields(header->body);
  RdSpoke spoke;
  spoke.azimuth = fields.little_endian<std::uint32_t>();
  if (spoke.azimuth >= kRdSpokes) {
    return failure(WireErrorKind::out_of_range, at + 8,
                   fmt::format("azimuth {} of {}", spoke.azimuth, kRdSpokes));
  }
  if (fields.little_endian<std::uint32_t>() != kFourBits) {
    return failure(WireErrorKind::unknown_kind, at + 12, "not cells of 4 bits");
  }
  auto data = take_part(reader);
  if (data && data->kind == kExtraHeader) data = take_part(reader);
  if (!data) return Failure<WireError>{data.error()};
  if ((data->kind & ~kLastOfFrame) != kData) {
    return failure(WireErrorKind::malformed, at + kSpokeHeaderBytes,
                   fmt::format("part {:#x} where a spoke's data were expected", data->kind));
  }
  ByteReader body(data->body);
  const auto length = body.little_endian<std::uint32_t>();
  if (body.truncated() || length > body.left()) {
    return failure(WireErrorKind::truncated, at + kSpokeHeaderBytes + kDataHeaderBytes,
                   fmt::format("{} bytes of video in {}", length, body.left()));
  }
  const auto plain = decode_runs(body.take(length), kRdCells / 2);
  if (!plain) {
    return failure(plain.error().kind,
                   at + kSpokeHeaderBytes + kDataHeaderBytes + plain.error().offset,
                   plain.error().text);
  }
  spoke.cells.reserve(kRdCells);
  for (const std::uint8_t pair : *plain) {
    spoke.cells.push_back(pair & 0x0F);
    spoke.cells.push_back(pair >> 4);
  }
  spoke.cells.resize(kRdCells);
  return spoke;
}

}  // namespace

Result<std::vector<RdSpoke>, WireError> decode_rd_spokes(std::span<const std::uint8_t> datagram) {
  ByteReader reader(datagram);
  const auto type = reader.little_endian<std::uint32_t>();
  reader.take(8);
  const auto count = reader.little_endian<std::uint32_t>();
  reader.take(16);
  if (reader.truncated()) {
    return failure(WireErrorKind::truncated, datagram.size(),
                   fmt::format("{} bytes, fewer than a frame's header of {}", datagram.size(),
                               kFrameHeaderBytes));
  }
  if (type != kRdSpokesType) {
    return failure(WireErrorKind::unknown_kind, 0, fmt::format("type {:#x}, no spokes", type));
  }
  if (count > reader.left() / (kSpokeHeaderBytes + kDataHeaderBytes)) {
    return failure(WireErrorKind::truncated, 12,
                   fmt::format("{} spokes in {} bytes", count, reader.left()));
  }
  std::vector<RdSpoke> spokes;
  spokes.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    auto spoke = take_spoke(reader);
    if (!spoke) return Failure<WireError>{spoke.error()};
    spokes.push_back(std::move(*spoke));
  }
  return spokes;
}

Result<RdStatus, WireError> decode_rd_status(std::span<const std::uint8_t> datagram) {
  constexpr std::size_t kStateAt = 180, kWarmUpAt = 184, kBarsAt = 185, kRangeAt = 193;
  if (datagram.size() <= kRangeAt) {
    return failure(WireErrorKind::truncated, datagram.size(),
                   fmt::format("{} bytes, a status has more than {}", datagram.size(), kRangeAt));
  }
  ByteReader reader(datagram);
  if (reader.little_endian<std::uint32_t>() != kRdStatusType) {
    return failure(WireErrorKind::unknown_kind, 0, "not a status, which is type 0x010001");
  }
  RdStatus status;
  for (std::uint32_t& range : status.ranges) range = reader.little_endian<std::uint32_t>();
  status.state = datagram[kStateAt];
  status.warm_up_s = datagram[kWarmUpAt];
  status.signal_bars = datagram[kBarsAt];
  status.range_index = datagram[kRangeAt];
  if (status.range_index >= kRdRanges) {
    return failure(WireErrorKind::out_of_range, kRangeAt,
                   fmt::format("range {} of {}", status.range_index, kRdRanges));
  }
  return status;
}

}  // namespace skerry::raymarine
