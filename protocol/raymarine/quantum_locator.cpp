#include "protocol/raymarine/quantum_locator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "protocol/wire/byte_order.hpp"

namespace skerry::raymarine {
namespace {

constexpr std::size_t kAddressesBytes = 36, kNameBytes = 56, kNameOffset = 20, kNameLength = 32;
constexpr std::uint32_t kAddressesType = 0, kNameType = 1, kLongNameType = 2;

// Meaning unknown; the same in all packets of the capture.
constexpr std::array<std::uint8_t, 8> kAfterModel = {0x03, 0x00, 0x64, 0x00,
                                                     0x06, 0x08, 0x10, 0x00};
constexpr std::uint16_t kAfterDataPort = 0x11, kAfterRadarPort = 0x36;
constexpr std::uint32_t kBeforeName = 0xF3;
constexpr std::array<std::uint8_t, 4> kFactoryAddress = {0xD7, 0x00, 0xA8, 0xC0};  // 192.168.0.215

Ipv4Endpoint read_endpoint(ByteReader& reader) {
  Ipv4Endpoint endpoint;
  endpoint.address = reader.little_endian<std::uint32_t>();
  endpoint.port = reader.little_endian<std::uint16_t>();
  reader.take(2);
  return endpoint;
}

std::optional<WireError> fault_of(std::span<const std::uint8_t> datagram, std::size_t bytes,
                                  std::uint32_t type) {
  if (datagram.size() != bytes) {
    const bool short_of = datagram.size() < bytes;
    return WireError{
        short_of ? WireErrorKind::truncated : WireErrorKind::oversized,
        std::min(datagram.size(), bytes),
        fmt::format("{} bytes, a locator's packet of this kind has {}", datagram.size(), bytes)};
  }
  if (ByteReader(datagram).little_endian<std::uint32_t>() != type) {
    return WireError{WireErrorKind::unknown_kind, 0, fmt::format("type {} was expected", type)};
  }
  return std::nullopt;
}

void append_name(Bytes& out, std::uint32_t type, const LocatorName& name) {
  append_little_endian(out, type, 4);
  append_little_endian(out, name.id.model, 4);
  append_little_endian(out, name.id.link_id, 4);
  append_little_endian(out, kBeforeName, 4);
  out.insert(out.end(), kFactoryAddress.begin(), kFactoryAddress.end());
  const std::size_t length = std::min(name.name.size(), kNameLength);
  out.insert(out.end(), name.name.begin(), name.name.begin() + static_cast<std::ptrdiff_t>(length));
  out.insert(out.end(), kNameLength - length, std::uint8_t{0});
}

}  // namespace

Result<LocatorAddresses, WireError> decode_locator_addresses(
    std::span<const std::uint8_t> datagram) {
  if (auto fault = fault_of(datagram, kAddressesBytes, kAddressesType)) {
    return Failure<WireError>{std::move(*fault)};
  }
  ByteReader reader(datagram);
  reader.take(4);
  LocatorAddresses addresses;
  addresses.id.link_id = reader.little_endian<std::uint32_t>();
  addresses.id.model = reader.little_endian<std::uint32_t>();
  reader.take(kAfterModel.size());
  addresses.data = read_endpoint(reader);
  addresses.radar = read_endpoint(reader);
  return addresses;
}

Bytes encode_locator_addresses(const LocatorAddresses& addresses) {
  Bytes out;
  append_little_endian(out, kAddressesType, 4);
  append_little_endian(out, addresses.id.link_id, 4);
  append_little_endian(out, addresses.id.model, 4);
  out.insert(out.end(), kAfterModel.begin(), kAfterModel.end());
  append_little_endian(out, addresses.data.address, 4);
  append_little_endian(out, addresses.data.port, 2);
  append_little_endian(out, kAfterDataPort, 2);
  append_little_endian(out, addresses.radar.address, 4);
  append_little_endian(out, addresses.radar.port, 2);
  append_little_endian(out, kAfterRadarPort, 2);
  return out;
}

Result<LocatorName, WireError> decode_locator_name(std::span<const std::uint8_t> datagram) {
  if (auto fault = fault_of(datagram, kNameBytes, kNameType)) {
    return Failure<WireError>{std::move(*fault)};
  }
  ByteReader reader(datagram);
  reader.take(4);
  LocatorName name;
  name.id.model = reader.little_endian<std::uint32_t>();
  name.id.link_id = reader.little_endian<std::uint32_t>();
  const auto letters = datagram.subspan(kNameOffset, kNameLength);
  name.name.assign(letters.begin(), std::find(letters.begin(), letters.end(), 0));
  return name;
}

Bytes encode_locator_name(const LocatorName& name) {
  Bytes out;
  append_name(out, kNameType, name);
  append_little_endian(out, 2, 4);
  return out;
}

Bytes encode_locator_long_name(const LocatorName& name, const Ipv4Endpoint& radar) {
  Bytes out;
  append_name(out, kLongNameType, name);
  append_little_endian(out, 0x10, 4);
  append_little_endian(out, 0xEEEE, 4);
  append_little_endian(out, 0x20008, 4);
  append_little_endian(out, radar.address, 4);
  append_little_endian(out, radar.port, 2);
  return out;
}

}  // namespace skerry::raymarine
