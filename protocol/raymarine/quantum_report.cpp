#include "protocol/raymarine/quantum_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/wire/byte_order.hpp"

namespace skerry::raymarine {
namespace {

constexpr std::size_t kState = 4, kBearingOffset = 14, kRejection = 17, kRange = 20, kMode = 21,
                      kControls = 22, kExpansion = 54, kMainBang = 59, kRanges = 148;
constexpr std::size_t kPartNumber = 4, kPartNumberLength = 6, kSerialNumber = 10,
                      kSerialNumberLength = 7;

// Bytes of a status up to the ranges, and after them, as captured; those that are known are
// overwritten.
constexpr std::array<std::uint8_t, kRanges> kStatusHead = {
    0x02, 0x00, 0x28, 0x00, 0x01, 0x00, 0x00, 0x00, 0x03, 0x1e, 0x00, 0x00,  //
    0x00, 0x00, 0x00, 0x00, 0x64, 0x03, 0x01, 0x01, 0x09, 0x00, 0x00, 0x36,  //
    0x00, 0x09, 0x00, 0x00, 0x01, 0x00, 0x01, 0x41, 0x00, 0x1b, 0x00, 0x00,  //
    0x00, 0x00, 0x00, 0x55, 0x00, 0x2d, 0x01, 0x15, 0x00, 0x00, 0x01, 0x5a,  //
    0x01, 0x32, 0x01, 0x00, 0x00, 0x00, 0x01, 0x00, 0xe6, 0x00, 0x00, 0x01,  //
    0x09, 0x00, 0x01, 0x41, 0x01, 0x32, 0x01, 0x00, 0x00, 0x00, 0x01, 0x4b,  //
    0x01, 0x32, 0x01, 0x00, 0x00, 0x00, 0x01, 0x4b, 0x01, 0x32, 0x01, 0x00,  //
    0x00, 0x00, 0x01, 0x5a, 0x01, 0x32, 0x01, 0x00, 0x00, 0x00, 0x00, 0x01,  //
    0xa4, 0x00, 0x00, 0x01, 0xee, 0x02, 0x00, 0x00, 0xe8, 0x03, 0x00, 0x00,  //
    0x4a, 0x01, 0x1e, 0x00, 0x00, 0x00, 0x00, 0x00, 0xd0, 0x07, 0x00, 0x00,  //
    0xc4, 0x09, 0x00, 0x00, 0x96, 0x00, 0xd2};
constexpr std::array<std::uint8_t, 32> kStatusTail = {
    0x7a, 0x02, 0x00, 0x00, 0xc6, 0x0f, 0x00, 0x00, 0x23, 0x04, 0x23, 0x04, 0x00, 0x00, 0x00, 0x00,
    0xf4, 0x01, 0x00, 0x00, 0xdc, 0x05, 0x00, 0x00, 0x08, 0x07, 0x08, 0x07, 0x00, 0x00, 0x00, 0x00};

constexpr std::array<std::uint8_t, 68> kInfo = {
    0x01, 0x00, 0x28, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  //
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xd7, 0x00, 0xa8, 0xc0,  //
    0x74, 0xe1, 0x82, 0x2c, 0x4c, 0x1d, 0x02, 0x2b, 0x00, 0x00, 0x01, 0x01,  //
    0x02, 0x1c, 0x01, 0x3e, 0x01, 0x3e, 0x01, 0x3e, 0x02, 0x04, 0x00, 0x00,  //
    0x01, 0x00, 0x01, 0x01, 0xd4, 0x0d, 0x26, 0x01, 0x3d, 0x00, 0x01};

struct ShortReport {
  std::uint32_t type;
  std::uint32_t value;
};
constexpr std::array<ShortReport, kQuantumShortTypes.size()> kShortReports = {{
    {0x280007, 0x004a5900},
    {0x280030, 0x00010003},
    {0x280031, 0x01350001},
    {0x280b01, 0},
}};

constexpr std::uint32_t kLongType = 0x280008, kCountType = 0x288942;

std::string text_at(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t length) {
  const auto letters = bytes.subspan(offset, length);
  return {letters.begin(), std::find(letters.begin(), letters.end(), 0)};
}

void put_text(Bytes& out, std::size_t offset, std::size_t length, const std::string& text) {
  std::copy_n(text.begin(), std::min(length, text.size()),
              out.begin() + static_cast<std::ptrdiff_t>(offset));
}

}  // namespace

Result<QuantumStatus, WireError> decode_quantum_status(std::span<const std::uint8_t> datagram) {
  if (datagram.size() != kQuantumStatusBytes) {
    return failure(
        datagram.size() < kQuantumStatusBytes ? WireErrorKind::truncated : WireErrorKind::oversized,
        std::min(datagram.size(), kQuantumStatusBytes),
        fmt::format("{} bytes, a status has {}", datagram.size(), kQuantumStatusBytes));
  }
  if (ByteReader(datagram).little_endian<std::uint32_t>() != kQuantumStatusType) {
    return failure(WireErrorKind::unknown_kind, 0, "not a status, which is type 0x280002");
  }
  QuantumStatus status;
  status.transmits = datagram[kState] == 1;
  status.bearing_offset =
      static_cast<std::int16_t>(little_endian_at<std::uint16_t>(datagram, kBearingOffset));
  status.rejection = datagram[kRejection];
  status.range_index = datagram[kRange];
  if (status.range_index >= status.ranges.size()) {
    return failure(WireErrorKind::out_of_range, kRange,
                   fmt::format("range {} of {}", status.range_index, status.ranges.size()));
  }
  if (datagram[kMode] >= kQuantumModes) {
    return failure(WireErrorKind::out_of_range, kMode,
                   fmt::format("mode {} of {}", datagram[kMode], kQuantumModes));
  }
  status.mode = static_cast<QuantumMode>(datagram[kMode]);
  ByteReader reader(datagram.subspan(kControls));
  for (QuantumModeControls& mode : status.controls) {
    mode.gain_auto = reader.octet() != 0;
    mode.gain = reader.octet();
    mode.colour_auto = reader.octet() != 0;
    mode.colour = reader.octet();
    mode.sea_auto = reader.octet() != 0;
    mode.sea = reader.octet();
    mode.rain_on = reader.octet() != 0;
    mode.rain = reader.octet();
  }
  status.expansion = datagram[kExpansion];
  status.main_bang = datagram[kMainBang];
  reader = ByteReader(datagram.subspan(kRanges));
  for (std::uint32_t& range : status.ranges) range = reader.little_endian<std::uint32_t>();
  return status;
}

Bytes encode_quantum_status(const QuantumStatus& status) {
  Bytes out(kStatusHead.begin(), kStatusHead.end());
  out[kState] = status.transmits ? 1 : 0;
  put_little_endian(out, kBearingOffset, static_cast<std::uint16_t>(status.bearing_offset), 2);
  out[kRejection] = status.rejection;
  out[kRange] = status.range_index;
  out[kMode] = static_cast<std::uint8_t>(status.mode);
  std::size_t at = kControls;
  for (const QuantumModeControls& mode : status.controls) {
    out[at++] = mode.gain_auto ? 1 : 0;
    out[at++] = mode.gain;
    out[at++] = mode.colour_auto ? 1 : 0;
    out[at++] = mode.colour;
    out[at++] = mode.sea_auto ? 1 : 0;
    out[at++] = mode.sea;
    out[at++] = mode.rain_on ? 1 : 0;
    out[at++] = mode.rain;
  }
  out[kExpansion] = status.expansion;
  out[kMainBang] = status.main_bang;
  for (const std::uint32_t range : status.ranges) append_little_endian(out, range, 4);
  out.insert(out.end(), kStatusTail.begin(), kStatusTail.end());
  return out;
}

Result<QuantumInfo, WireError> decode_quantum_info(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kSerialNumber + kSerialNumberLength) {
    return failure(WireErrorKind::truncated, datagram.size(),
                   fmt::format("{} bytes, a radar's name ends at {}", datagram.size(),
                               kSerialNumber + kSerialNumberLength));
  }
  if (ByteReader(datagram).little_endian<std::uint32_t>() != kQuantumInfoType) {
    return failure(WireErrorKind::unknown_kind, 0, "not a radar's name, which is type 0x280001");
  }
  return QuantumInfo{text_at(datagram, kPartNumber, kPartNumberLength),
                     text_at(datagram, kSerialNumber, kSerialNumberLength)};
}

Bytes encode_quantum_info(const QuantumInfo& info) {
  Bytes out(kInfo.begin(), kInfo.end());
  put_text(out, kPartNumber, kPartNumberLength, info.part_number);
  put_text(out, kSerialNumber, kSerialNumberLength, info.serial_number);
  return out;
}

Bytes encode_quantum_short(std::uint32_t type) {
  Bytes out;
  append_little_endian(out, type, 4);
  for (const ShortReport& report : kShortReports) {
    if (report.type == type) append_little_endian(out, report.value, 4);
  }
  return out;
}

Bytes encode_quantum_long() {
  Bytes out(532);
  put_little_endian(out, 0, kLongType, 4);
  put_little_endian(out, 4, 7, 4);
  out[20] = 1;
  out[24] = 16;
  out[28] = 25;
  return out;
}

Bytes encode_quantum_count(std::uint32_t count) {
  Bytes out(72);
  put_little_endian(out, 0, kCountType, 4);
  put_little_endian(out, 4, count, 4);
  return out;
}

}  // namespace skerry::raymarine
