#include "protocol/raymarine/quantum_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "protocol/wire/byte_order.hpp"

namespace skerry::raymarine {
namespace {

struct Form {
  std::uint32_t code;  // first four bytes
  QuantumControl control;
  std::uint8_t offset;  // of the value
  std::uint8_t octets;  // of the value, in two's complement; 0: none
  std::uint8_t length;  // of the datagram, as displays send it
  std::int32_t least, greatest;
};

// The first of a control is the one that is encoded.
constexpr std::array<Form, 23> kForms = {{
    {0x280000, QuantumControl::stay_alive, 0, 0, 12, 0, 0},
    {0x288903, QuantumControl::stay_alive, 0, 0, 36, 0, 0},
    {0x280010, QuantumControl::transmit, 4, 1, 8, 0, 1},
    {0x018001, QuantumControl::transmit, 4, 1, 8, 0, 1},
    {0x280101, QuantumControl::range_index, 5, 1, 8, 0, 19},
    {0x280301, QuantumControl::gain_auto, 5, 1, 8, 0, 1},
    {0x018301, QuantumControl::gain_auto, 16, 1, 24, 0, 1},
    {0x280302, QuantumControl::gain, 5, 1, 8, 0, 100},
    {0x288302, QuantumControl::gain, 5, 1, 8, 0, 100},
    {0x280303, QuantumControl::colour_auto, 5, 1, 8, 0, 1},
    {0x280304, QuantumControl::colour, 5, 1, 8, 0, 100},
    {0x280305, QuantumControl::sea_auto, 5, 1, 8, 0, 1},
    {0x280306, QuantumControl::sea, 5, 1, 8, 0, 100},
    {0x28030b, QuantumControl::rain_on, 5, 1, 8, 0, 1},
    {0x018303, QuantumControl::rain_on, 16, 1, 24, 0, 1},
    {0x28030c, QuantumControl::rain, 5, 1, 8, 0, 100},
    {0x28030f, QuantumControl::expansion, 5, 1, 8, 0, 1},
    {0x018306, QuantumControl::expansion, 8, 1, 12, 0, 1},
    {0x280311, QuantumControl::rejection, 4, 1, 8, 0, 5},
    {0x018307, QuantumControl::rejection, 4, 1, 8, 0, 5},
    {0x280314, QuantumControl::mode, 5, 1, 8, 0, 3},
    {0x280401, QuantumControl::bearing_offset, 4, 2, 8, -1800, 1800},
    {0x018207, QuantumControl::bearing_offset, 4, 4, 8, -1800, 1800},
}};

std::int64_t signed_value(std::span<const std::uint8_t> bytes) {
  const auto bits = little_endian_at<std::uint32_t>(bytes, 0, bytes.size());
  return bytes.size() == 2 ? static_cast<std::int16_t>(bits) : static_cast<std::int32_t>(bits);
}

}  // namespace

Result<QuantumCommand, WireError> decode_quantum_command(std::span<const std::uint8_t> datagram) {
  ByteReader reader(datagram);
  const auto code = reader.little_endian<std::uint32_t>();
  if (reader.truncated()) {
    return Failure{WireError{WireErrorKind::truncated, datagram.size(),
                             fmt::format("{} bytes, a command has at least 8", datagram.size())}};
  }
  const auto found = std::find_if(kForms.begin(), kForms.end(),
                                  [&](const Form& form) { return form.code == code; });
  if (found == kForms.end()) {
    return Failure{WireError{WireErrorKind::unknown_kind, 0,
                             fmt::format("{:#08x} is no command of a display", code)}};
  }
  const Form& form = *found;
  if (datagram.size() < std::size_t{form.offset} + form.octets) {
    return Failure{WireError{WireErrorKind::truncated, datagram.size(),
                             fmt::format("{} bytes, the value of {:#08x} ends at {}",
                                         datagram.size(), code, form.offset + form.octets)}};
  }
  const auto bytes = datagram.subspan(form.offset, form.octets);
  const std::int64_t value = form.octets > 1    ? signed_value(bytes)
                             : form.octets == 1 ? std::int64_t{bytes[0]}
                                                : 0;
  const std::int64_t within =
      std::clamp(value, std::int64_t{form.least}, std::int64_t{form.greatest});
  return QuantumCommand{form.control, static_cast<std::int32_t>(within), within != value};
}

Bytes encode_quantum_command(QuantumControl control, std::int32_t value) {
  const auto form = std::find_if(kForms.begin(), kForms.end(),
                                 [&](const Form& each) { return each.control == control; });
  Bytes out(form->length);
  put_little_endian(out, 0, form->code, 4);
  if (control == QuantumControl::stay_alive) {
    constexpr std::array<std::uint8_t, 5> kRadar = {'R', 'a', 'd', 'a', 'r'};
    std::copy(kRadar.begin(), kRadar.end(), out.begin() + 4);
  }
  put_little_endian(out, form->offset, static_cast<std::uint32_t>(value), form->octets);
  return out;
}

}  // namespace skerry::raymarine
