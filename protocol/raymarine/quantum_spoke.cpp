#include "protocol/raymarine/quantum_spoke.hpp"

#include <fmt/format.h>

#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/run_length.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::raymarine {
namespace {

constexpr std::size_t kHeaderBytes = 20, kLengthOffset = 18;
// Meaning unknown; the same in all spokes of the capture.
constexpr std::uint16_t kAfterSequence = 0x0101, kAfterSpokes = 8;

}  // namespace

Result<QuantumSpoke, WireError> decode_quantum_spoke(std::span<const std::uint8_t> datagram) {
  ByteReader reader(datagram);
  const auto type = reader.little_endian<std::uint32_t>();
  QuantumSpoke spoke;
  spoke.sequence = reader.little_endian<std::uint16_t>();
  reader.take(2);
  const auto cells = reader.little_endian<std::uint16_t>();
  const auto spokes = reader.little_endian<std::uint16_t>();
  reader.take(2);
  spoke.cells_per_range = reader.little_endian<std::uint16_t>();
  spoke.azimuth = reader.little_endian<std::uint16_t>();
  const auto length = reader.little_endian<std::uint16_t>();
  if (reader.truncated()) {
    return failure(
        WireErrorKind::truncated, datagram.size(),
        fmt::format("{} bytes, fewer than a spoke's header of {}", datagram.size(), kHeaderBytes));
  }
  if (type != kQuantumSpokeType) {
    return failure(
        WireErrorKind::unknown_kind, 0,
        fmt::format("type {:#x} where a spoke, {:#x}, was expected", type, kQuantumSpokeType));
  }
  if (cells > kQuantumMaxCells) {
    return failure(WireErrorKind::out_of_range, 8,
                   fmt::format("{} cells, at most {} were expected", cells, kQuantumMaxCells));
  }
  if (spokes != kQuantumSpokes || spoke.azimuth >= spokes) {
    return failure(
        WireErrorKind::out_of_range, 10,
        fmt::format("azimuth {} of {}, a turn has {}", spoke.azimuth, spokes, kQuantumSpokes));
  }
  if (length > reader.left()) {
    return failure(WireErrorKind::truncated, kLengthOffset,
                   fmt::format("{} bytes of video in {}", length, reader.left()));
  }
  auto plain = decode_runs(reader.take(length), cells);
  if (!plain) {
    return failure(plain.error().kind, kHeaderBytes + plain.error().offset, plain.error().text);
  }
  spoke.cells = std::move(*plain);
  spoke.cells.resize(cells);
  return spoke;
}

void append_quantum_spoke(Bytes& out, const QuantumSpoke& spoke) {
  append_little_endian(out, kQuantumSpokeType, 4);
  append_little_endian(out, spoke.sequence, 2);
  append_little_endian(out, kAfterSequence, 2);
  append_little_endian(out, spoke.cells.size(), 2);
  append_little_endian(out, kQuantumSpokes, 2);
  append_little_endian(out, kAfterSpokes, 2);
  append_little_endian(out, spoke.cells_per_range, 2);
  append_little_endian(out, spoke.azimuth, 2);
  const std::size_t length_at = out.size();
  append_little_endian(out, 0, 2);
  append_runs(out, spoke.cells);
  put_little_endian(out, length_at, out.size() - length_at - 2, 2);
}

}  // namespace skerry::raymarine
