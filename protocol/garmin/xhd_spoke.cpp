#include "protocol/garmin/xhd_spoke.hpp"

#include <fmt/format.h>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::garmin {
namespace {

constexpr std::uint16_t kLayout = 0x108;                     // of unknown meaning; always this
constexpr std::size_t kAfterLength = kSpokeHeaderBytes - 8;  // header bytes that a length counts

}  // namespace

Result<SpokePacket, WireError> decode_spoke(std::span<const std::uint8_t> datagram) {
  const auto packet = decode_packet(datagram);
  if (!packet) return Failure<WireError>{packet.error()};
  if (!packet->is(Type::spoke)) {
    return failure(WireErrorKind::unknown_kind, 0,
                   fmt::format("type {:#x} where a spoke, 0x998, was expected", packet->type));
  }
  ByteReader reader(packet->payload);
  reader.take(2);
  const auto length = reader.little_endian<std::uint16_t>();
  SpokePacket spoke;
  spoke.angle = reader.little_endian<std::uint16_t>();
  reader.take(2);
  spoke.range_m = reader.little_endian<std::uint32_t>();
  spoke.span_m = reader.little_endian<std::uint32_t>();
  reader.take(2);
  const auto cells = reader.little_endian<std::uint16_t>();
  reader.take(2);
  const auto cells_again = reader.little_endian<std::uint32_t>();
  reader.take(2);
  if (reader.truncated()) {
    return failure(WireErrorKind::truncated, datagram.size(),
                   fmt::format("{} bytes, fewer than a spoke's header of {}", datagram.size(),
                               kSpokeHeaderBytes));
  }
  if (spoke.angle >= kAnglesPerTurn) {
    return failure(WireErrorKind::out_of_range, 12,
                   fmt::format("angle {} of {}", spoke.angle, kAnglesPerTurn));
  }
  if (cells > kMaxCells) {
    return failure(WireErrorKind::out_of_range, 26,
                   fmt::format("{} cells, at most {} were expected", cells, kMaxCells));
  }
  if (cells_again != cells || length != cells + kAfterLength || reader.left() < cells) {
    return failure(WireErrorKind::malformed, 26,
                   fmt::format("{}, {} and {} bytes of cells in {}", cells, cells_again,
                               int{length} - int{kAfterLength}, reader.left()));
  }
  spoke.cells = reader.take(cells);
  return spoke;
}

void append_spoke(Bytes& out, const SpokePacket& spoke) {
  const std::size_t cells = spoke.cells.size();
  append_little_endian(out, static_cast<std::uint32_t>(Type::spoke), 4);
  append_little_endian(out, kAfterLength + cells, 4);
  append_little_endian(out, 1, 2);
  append_little_endian(out, kAfterLength + cells, 2);
  append_little_endian(out, spoke.angle, 2);
  append_little_endian(out, 0, 2);
  append_little_endian(out, spoke.range_m, 4);
  append_little_endian(out, spoke.span_m, 4);
  append_little_endian(out, 0, 2);
  append_little_endian(out, cells, 2);
  append_little_endian(out, kLayout, 2);
  append_little_endian(out, cells, 4);
  append_little_endian(out, 0, 2);
  out.insert(out.end(), spoke.cells.begin(), spoke.cells.end());
}

}  // namespace skerry::garmin
