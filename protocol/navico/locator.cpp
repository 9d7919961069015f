#include "protocol/navico/locator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

constexpr std::size_t kSerialCharacters = 16;
constexpr std::uint8_t kServiceMark = 0x20;

// Addresses stand in network order, everything else little-endian.
void append_endpoint(Bytes& out, const Ipv4Endpoint& endpoint) {
  append_big_endian(out, endpoint.address, 4);
  append_big_endian(out, endpoint.port, 2);
}

Ipv4Endpoint read_endpoint(ByteReader& in) {
  Ipv4Endpoint endpoint;
  endpoint.address = in.big_endian<std::uint32_t>();
  endpoint.port = in.big_endian<std::uint16_t>();
  return endpoint;
}

std::uint16_t read_word(ByteReader& in) {
  const std::uint8_t low = in.octet();
  return static_cast<std::uint16_t>(low | in.octet() << 8);
}

WireError wrong_locator(WireErrorKind kind, std::size_t offset, std::string text) {
  return {kind, offset, "Navico locator: " + std::move(text)};
}

std::uint16_t role_of(LocatorRole role) { return static_cast<std::uint16_t>(role); }

LocatorService three_groups(std::uint16_t kind, std::uint8_t instance, const Addresses& at) {
  return {kind,
          instance,
          {{role_of(LocatorRole::data), at.data},
           {role_of(LocatorRole::send), at.send},
           {role_of(LocatorRole::report), at.report}}};
}

// The further services a HALO20 names; displays of pictures do not use them.
constexpr Ipv4Endpoint kService1Groups[] = {{ipv4(236, 6, 7, 12), 6000},
                                            {ipv4(236, 6, 7, 22), 6694}};
constexpr Ipv4Endpoint kService2Groups[] = {{ipv4(236, 6, 7, 23), 6684},
                                            {ipv4(236, 6, 7, 24), 6685}};
constexpr std::uint16_t kService1 = 0xFFFD, kService2 = 0x001F, kTargetService = 0x0012;
constexpr Addresses kTargetsA{
    {ipv4(236, 6, 7, 18), 6688}, {ipv4(236, 6, 7, 20), 6690}, {ipv4(236, 6, 7, 19), 6689}};
constexpr Addresses kTargetsB{
    {ipv4(236, 6, 7, 28), 6698}, {ipv4(236, 6, 7, 30), 6700}, {ipv4(236, 6, 7, 29), 6699}};

}  // namespace

Bytes encode_locator_question() { return {0x01, 0xB1}; }

bool is_locator_question(std::span<const std::uint8_t> datagram) {
  return datagram.size() == 2 && datagram[0] == 0x01 && datagram[1] == 0xB1;
}

std::optional<Addresses> Locator::find_picture(std::uint8_t instance) const {
  for (const LocatorService& service : services) {
    if (service.kind != kPictureService || service.instance != instance) continue;
    Addresses found;
    for (const LocatorGroup& group : service.groups) {
      if (group.role == role_of(LocatorRole::data)) found.data = group.at;
      if (group.role == role_of(LocatorRole::send)) found.send = group.at;
      if (group.role == role_of(LocatorRole::report)) found.report = group.at;
    }
    return found;
  }
  return std::nullopt;
}

Bytes encode_locator(const Locator& locator) {
  Bytes out = {0x01, 0xB2};
  for (std::size_t i = 0; i < kSerialCharacters; ++i) {
    out.push_back(i < locator.serial.size() ? static_cast<std::uint8_t>(locator.serial[i]) : 0);
  }
  append_endpoint(out, locator.radar);
  append_little_endian(out, locator.services.size(), 2);
  for (const LocatorService& service : locator.services) {
    append_little_endian(out, service.kind, 2);
    out.push_back(kServiceMark);
    out.push_back(service.instance);
    append_little_endian(out, service.groups.size(), 2);
    for (const LocatorGroup& group : service.groups) {
      append_little_endian(out, group.role, 4);
      append_endpoint(out, group.at);
    }
  }
  return out;
}

Result<Locator, WireError> decode_locator(std::span<const std::uint8_t> datagram) {
  if (datagram.size() > kMaxLocator) {
    return Failure{
        wrong_locator(WireErrorKind::oversized, kMaxLocator,
                      fmt::format("{} octets, expected at most {}", datagram.size(), kMaxLocator))};
  }
  ByteReader in(datagram);
  const std::uint8_t first = in.octet(), second = in.octet();
  if (!in.truncated() && (first != 0x01 || second != 0xB2)) {
    return Failure{wrong_locator(WireErrorKind::unknown_kind, 0, "does not begin 01B2")};
  }
  Locator locator;
  for (const std::uint8_t character : in.take(kSerialCharacters)) {
    if (character == 0) break;
    locator.serial += static_cast<char>(character);
  }
  locator.radar = read_endpoint(in);
  const std::size_t services = read_word(in);
  for (std::size_t s = 0; s < services && !in.truncated(); ++s) {
    LocatorService service;
    service.kind = read_word(in);
    const std::uint8_t mark = in.octet();
    service.instance = in.octet();
    const std::size_t groups = read_word(in);
    if (!in.truncated() && mark != kServiceMark) {
      return Failure{wrong_locator(WireErrorKind::malformed, in.offset() - 4,
                                   fmt::format("service marked {:02X}, expected 20", mark))};
    }
    for (std::size_t g = 0; g < groups && !in.truncated(); ++g) {
      LocatorGroup group;
      group.role = read_word(in);
      in.take(2);
      group.at = read_endpoint(in);
      if (!in.truncated()) service.groups.push_back(group);
    }
    if (!in.truncated()) locator.services.push_back(std::move(service));
  }
  if (in.truncated()) {
    return Failure{wrong_locator(
        WireErrorKind::truncated, datagram.size(),
        fmt::format("ends after {} octets, within its {} services", datagram.size(), services))};
  }
  return locator;
}

Locator make_locator(std::string serial, Ipv4Endpoint radar, const Addresses& a,
                     const std::optional<Addresses>& b) {
  const auto two_groups = [](std::uint16_t kind, const Ipv4Endpoint(&at)[2]) {
    return LocatorService{
        kind, 1, {{role_of(LocatorRole::data), at[0]}, {role_of(LocatorRole::send), at[1]}}};
  };
  Locator locator{std::move(serial), radar, {}};
  locator.services.push_back(two_groups(kService1, kService1Groups));
  locator.services.push_back(two_groups(kService2, kService2Groups));
  locator.services.push_back(three_groups(kPictureService, 1, a));
  if (b) locator.services.push_back(three_groups(kPictureService, 2, *b));
  locator.services.push_back(three_groups(kTargetService, 1, kTargetsA));
  if (b) locator.services.push_back(three_groups(kTargetService, 2, kTargetsB));
  return locator;
}

}  // namespace skerry::navico
