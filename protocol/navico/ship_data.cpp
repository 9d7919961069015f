#include "protocol/navico/ship_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

constexpr double kTurn = kRadiansPerTurn / 1e-4;  // 62831.85 units of 1e-4 rad are a turn
constexpr std::uint32_t kTurnUnits = 62'832;      // the first that is a turn or more
constexpr std::array<std::uint8_t, 4> kMark = {'N', 'K', 'O', 'E'};
constexpr std::size_t kCounter = 8, kKind = 36, kHeading = 65, kCourse = 66, kSpeed = 68;
constexpr std::uint16_t kHeadingKind = 0xF112, kNavigationKind = 0xF802;  // as little-endian

std::uint16_t to_turn_units(double degrees) {
  const double units = wrapped_degrees(degrees) / 360.0 * kTurn;
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(std::lround(units)) % kTurnUnits);
}

std::uint16_t to_steps(double value, double step) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(value / step + 0.5), 0.0, 65535.0));
}

Bytes begin_packet(std::uint16_t counter, std::uint16_t kind) {
  Bytes out(kShipOctets);
  std::copy(kMark.begin(), kMark.end(), out.begin());
  out[5] = 0x01;
  out[6] = 0x90;
  out[7] = 0x02;
  put_big_endian(out, kCounter, counter, 2);
  put_little_endian(out, kKind, kind, 2);
  return out;
}

WireError wrong_packet(WireErrorKind kind, std::size_t offset, std::string text) {
  return {kind, offset, "Navico ship packet: " + std::move(text)};
}

}  // namespace

Bytes encode(const HeadingPacket& packet) {
  Bytes out = begin_packet(packet.counter, kHeadingKind);
  put_little_endian(out, kHeading, to_turn_units(packet.heading_deg), 2);
  return out;
}

Bytes encode(const NavigationPacket& packet) {
  Bytes out = begin_packet(packet.counter, kNavigationKind);
  put_little_endian(out, kCourse, to_turn_units(packet.course_deg), 2);
  put_little_endian(out, kSpeed, to_steps(packet.speed_mps, 0.01), 2);
  return out;
}

Bytes encode(const SpeedPacket& packet) {
  Bytes out(kSpeedOctets);
  out[0] = 0x01;
  out[1] = 0xD3;
  put_little_endian(out, 6, to_steps(packet.speed_mps, 0.1), 2);
  put_little_endian(out, 14, to_steps(wrapped_degrees(packet.course_deg), 0.1) % 3600, 2);
  return out;
}

Result<std::variant<HeadingPacket, NavigationPacket, SpeedPacket>, WireError> decode_ship_packet(
    std::span<const std::uint8_t> in) {
  using Packet = std::variant<HeadingPacket, NavigationPacket, SpeedPacket>;
  const bool speed = in.size() >= 2 && in[0] == 0x01 && in[1] == 0xD3;
  const std::size_t expected = speed ? kSpeedOctets : kShipOctets;
  if (in.size() != expected) {
    return Failure{wrong_packet(
        in.size() < expected ? WireErrorKind::truncated : WireErrorKind::oversized,
        std::min(in.size(), expected), fmt::format("{} octets, expected {}", in.size(), expected))};
  }
  const auto degrees = [&](std::size_t at, double turn) {
    return little_endian_at<std::uint16_t>(in, at) / turn * 360.0;
  };
  const auto beyond = [&](std::size_t at) {
    return Failure{
        wrong_packet(WireErrorKind::out_of_range, at,
                     fmt::format("an angle of {}", little_endian_at<std::uint16_t>(in, at)))};
  };
  if (speed) {
    const SpeedPacket packet{little_endian_at<std::uint16_t>(in, 6) * 0.1, degrees(14, 3600.0)};
    if (packet.course_deg >= 360.0) return beyond(14);
    return Packet(packet);
  }
  if (!std::equal(kMark.begin(), kMark.end(), in.begin())) {
    return Failure{wrong_packet(WireErrorKind::unknown_kind, 0, "does not begin NKOE")};
  }
  const auto counter = big_endian_at<std::uint16_t>(in, kCounter);
  const auto kind = little_endian_at<std::uint16_t>(in, kKind);
  if (kind == kHeadingKind) {
    const HeadingPacket packet{counter, degrees(kHeading, kTurn)};
    if (packet.heading_deg >= 360.0) return beyond(kHeading);
    return Packet(packet);
  }
  if (kind == kNavigationKind) {
    const NavigationPacket packet{counter, degrees(kCourse, kTurn),
                                  little_endian_at<std::uint16_t>(in, kSpeed) * 0.01};
    if (packet.course_deg >= 360.0) return beyond(kCourse);
    return Packet(packet);
  }
  return Failure{wrong_packet(WireErrorKind::unknown_kind, kKind,
                              fmt::format("kind {:04X} is not known", kind))};
}

}  // namespace skerry::navico
