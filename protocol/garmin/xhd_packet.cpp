#include "protocol/garmin/xhd_packet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "protocol/wire/byte_order.hpp"

namespace skerry::garmin {
namespace {

constexpr std::size_t kHeaderBytes = 8;

constexpr std::int64_t kHalfTurn = 180 * 32, kTurn = 360 * 32;
constexpr std::array<CommandRange, 21> kCommands = {{
    {Type::old_rejection, 0, 255},
    {Type::speed, 0, 2},
    {Type::transmit, 0, 1},
    {Type::rejection, 0, 255},
    {Type::gain_auto_level, 0, 1},
    {Type::range, 1, 200'000},
    {Type::gain_auto, 0, 2},
    {Type::gain, 0, 10'000},
    {Type::alignment, -kHalfTurn, kHalfTurn},
    {Type::crosstalk, 0, 255},
    {Type::rain_on, 0, 1},
    {Type::rain, 0, 10'000},
    {Type::sea_mode, 0, 2},
    {Type::sea, 0, 10'000},
    {Type::sea_auto_level, 0, 2},
    {Type::no_transmit_on, 0, 1},
    {Type::no_transmit_from, -kTurn, kTurn},
    {Type::no_transmit_to, -kTurn, kTurn},
    {Type::timed_on, 0, 1},
    {Type::timed_idle, 0, 65'535},
    {Type::timed_run, 0, 65'535},
}};

}  // namespace

std::optional<std::uint32_t> Packet::number() const {
  if (payload.size() != 1 && payload.size() != 2 && payload.size() != 4) return std::nullopt;
  return ByteReader(payload).little_endian<std::uint32_t>(payload.size());
}

std::optional<std::int32_t> Packet::signed_number() const {
  const auto bits = number();
  if (!bits) return std::nullopt;
  switch (payload.size()) {
    case 1:
      return static_cast<std::int8_t>(*bits);
    case 2:
      return static_cast<std::int16_t>(*bits);
    default:
      return static_cast<std::int32_t>(*bits);
  }
}

Result<Packet, WireError> decode_packet(std::span<const std::uint8_t> datagram) {
  ByteReader reader(datagram);
  const auto type = reader.little_endian<std::uint32_t>();
  const auto length = reader.little_endian<std::uint32_t>();
  if (reader.truncated()) {
    return failure(
        WireErrorKind::truncated, datagram.size(),
        fmt::format("{} bytes, fewer than a packet's header of {}", datagram.size(), kHeaderBytes));
  }
  if (length != reader.left()) {
    const bool short_of = length > reader.left();
    return failure(short_of ? WireErrorKind::truncated : WireErrorKind::oversized, 4,
                   fmt::format("a payload of {} bytes in a datagram that has {} for it", length,
                               reader.left()));
  }
  return Packet{type, datagram.subspan(kHeaderBytes)};
}

Bytes encode_packet(Type type, int octets, std::int64_t number) {
  Bytes bytes;
  append_little_endian(bytes, static_cast<std::uint32_t>(type), 4);
  append_little_endian(bytes, static_cast<std::uint64_t>(octets), 4);
  append_little_endian(bytes, static_cast<std::uint64_t>(number), octets);
  return bytes;
}

Bytes encode_packet(std::uint32_t type, std::span<const std::uint8_t> payload) {
  Bytes bytes;
  append_little_endian(bytes, type, 4);
  append_little_endian(bytes, payload.size(), 4);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

const CommandRange* find_command(std::uint32_t type) {
  const auto found = std::find_if(kCommands.begin(), kCommands.end(), [&](const auto& command) {
    return static_cast<std::uint32_t>(command.type) == type;
  });
  return found == kCommands.end() ? nullptr : &*found;
}

Result<Command, WireError> decode_command(std::span<const std::uint8_t> datagram) {
  const auto packet = decode_packet(datagram);
  if (!packet) return Failure<WireError>{packet.error()};
  const CommandRange* range = find_command(packet->type);
  if (range == nullptr) {
    return failure(WireErrorKind::unknown_kind, 0,
                   fmt::format("type {:#x} is no command of a display", packet->type));
  }
  const bool is_signed = range->least < 0;
  const auto number = packet->number();
  if (!number) {
    return failure(
        WireErrorKind::malformed, 4,
        fmt::format("a command's number has 1, 2 or 4 bytes, not {}", packet->payload.size()));
  }
  const std::int64_t value = is_signed ? *packet->signed_number() : std::int64_t{*number};
  const std::int64_t within = std::clamp(value, range->least, range->greatest);
  return Command{range->type, within, within != value};
}

}  // namespace skerry::garmin
