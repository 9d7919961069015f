#include "protocol/navico/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

using Kind = CommandKind;

// How the octets after the first two are laid out.
enum class Form : std::uint8_t {
  none,
  octet,      // value
  word,       // value u16
  long_word,  // value u32
  level,      // control, 0 0 0, automatic, 0 0 0, value
  halo_sea,
  sector,   // sector, 0 0 0, value
  angles,   // sector, 0 0 0, value, from u16, to u16
  antenna,  // what, 0 0 0, value u16
};

struct Row {
  std::uint16_t code;  // the first two octets, as written
  Form form;
  Kind kind;
};
constexpr std::array kRows = {
    Row{0x00C1, Form::octet, Kind::prepare},
    Row{0x01C1, Form::octet, Kind::transmit},
    Row{0x03C1, Form::long_word, Kind::range},
    Row{0x05C1, Form::word, Kind::bearing_alignment},
    Row{0x06C1, Form::level, Kind::gain},
    Row{0x08C1, Form::octet, Kind::interference},
    Row{0x09C1, Form::octet, Kind::expansion},
    Row{0x0AC1, Form::octet, Kind::boost},
    Row{0x0BC1, Form::octet, Kind::sea_state},
    Row{0x0DC1, Form::sector, Kind::blanking_on},
    Row{0x0EC1, Form::octet, Kind::local_interference},
    Row{0x0FC1, Form::octet, Kind::scan_speed},
    Row{0x10C1, Form::octet, Kind::mode},
    Row{0x11C1, Form::halo_sea, Kind::halo_sea},
    Row{0x12C1, Form::octet, Kind::expansion},
    Row{0x21C1, Form::octet, Kind::noise_rejection},
    Row{0x22C1, Form::octet, Kind::target_separation},
    Row{0x23C1, Form::octet, Kind::doppler},
    Row{0x24C1, Form::word, Kind::doppler_threshold},
    Row{0x30C1, Form::antenna, Kind::antenna_height},
    Row{0x31C1, Form::octet, Kind::accent_light},
    Row{0x40C1, Form::word, Kind::parking},
    Row{0xA0C1, Form::none, Kind::stay_alive},
    Row{0xC0C1, Form::angles, Kind::blanking_angles},
    Row{0x03C2, Form::none, Kind::ask_controls},
    Row{0x04C2, Form::none, Kind::ask_identity},
    Row{0x05C2, Form::none, Kind::ask_installation},
    Row{0x0AC2, Form::none, Kind::ask_other},
};

// The octet after the code of the controls that share 06C1, and of the antenna's two.
struct Control {
  std::uint8_t octet;
  Kind kind;
};
constexpr std::array kLevels = {Control{0, Kind::gain}, Control{2, Kind::sea},
                                Control{4, Kind::rain}, Control{5, Kind::side_lobe}};
constexpr std::array kAntenna = {Control{1, Kind::antenna_height},
                                 Control{3, Kind::antenna_offset}};
constexpr std::array kHaloSea = {Control{1, Kind::halo_sea_mode}, Control{2, Kind::halo_sea},
                                 Control{4, Kind::halo_sea_adjust}};

constexpr std::size_t octets_of(Form form) {
  switch (form) {
    case Form::none:
      return 2;
    case Form::octet:
      return 3;
    case Form::word:
      return 4;
    case Form::long_word:
    case Form::halo_sea:
      return 6;
    case Form::sector:
      return 7;
    case Form::antenna:
      return 8;
    case Form::level:
    case Form::angles:
      return 11;
  }
  return 2;
}

template <std::size_t N>
std::optional<Kind> find(const std::array<Control, N>& controls, std::uint8_t octet) {
  for (const Control& each : controls) {
    if (each.octet == octet) return each.kind;
  }
  return std::nullopt;
}

template <std::size_t N>
std::optional<std::uint8_t> find_octet(const std::array<Control, N>& controls, Kind kind) {
  for (const Control& each : controls) {
    if (each.kind == kind) return each.octet;
  }
  return std::nullopt;
}

// A value no range or angle has, for what does not fit.
constexpr std::int32_t kMostValue = 0x7FFFFFFF;

std::int32_t clamped(std::uint32_t value) {
  return static_cast<std::int32_t>(std::min<std::uint32_t>(value, kMostValue));
}

// Requires as many octets as the form has.  Nothing if a control of the form is not known.
std::optional<Command> read(const Row& row, std::span<const std::uint8_t> in) {
  Command command;
  command.kind = row.kind;
  std::optional<Kind> kind = row.kind;
  switch (row.form) {
    case Form::none:
      break;
    case Form::octet:
      command.value = in[2];
      break;
    case Form::word:
      command.value = little_endian_at<std::uint16_t>(in, 2);
      break;
    case Form::long_word:
      command.value = clamped(little_endian_at<std::uint32_t>(in, 2));
      break;
    case Form::level:
      kind = find(kLevels, in[2]);
      command.automatic = in[6];
      command.value = in[10];
      break;
    case Form::halo_sea:
      kind = find(kHaloSea, in[5]);
      command.automatic = in[2];
      // 00FF04 and 32FF04 have both been seen: the fourth octet is the one that counts.
      command.value = kind == Kind::halo_sea_adjust ? static_cast<std::int8_t>(in[4]) : in[4];
      break;
    case Form::sector:
      command.sector = in[2];
      command.value = in[6];
      break;
    case Form::angles:
      command.sector = in[2];
      command.value = in[6];
      command.from = little_endian_at<std::uint16_t>(in, 7);
      command.to = little_endian_at<std::uint16_t>(in, 9);
      break;
    case Form::antenna:
      kind = find(kAntenna, in[2]);
      command.value = little_endian_at<std::uint16_t>(in, 6);
      break;
  }
  if (!kind) return std::nullopt;
  command.kind = *kind;
  return command;
}

WireError wrong_command(WireErrorKind kind, std::size_t offset, std::string text) {
  return {kind, offset, "Navico command: " + std::move(text)};
}

}  // namespace

Result<Command, WireError> decode_command(std::span<const std::uint8_t> datagram) {
  const std::size_t size = datagram.size();
  if (size < 2) {
    return Failure{wrong_command(WireErrorKind::truncated, size, fmt::format("{} octets", size))};
  }
  if (size > kMaxCommand) {
    return Failure{wrong_command(WireErrorKind::oversized, kMaxCommand,
                                 fmt::format("{} octets, expected at most {}", size, kMaxCommand))};
  }
  const auto code = big_endian_at<std::uint16_t>(datagram, 0);
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& each) { return each.code == code; });
  if (row == kRows.end()) {
    return Failure{
        wrong_command(WireErrorKind::unknown_kind, 0, fmt::format("{:04X} is not known", code))};
  }
  const std::size_t needed = octets_of(row->form);
  if (size < needed) {
    return Failure{
        wrong_command(WireErrorKind::truncated, size,
                      fmt::format("{:04X} of {} octets, expected {}", code, size, needed))};
  }
  const auto command = read(*row, datagram);
  if (!command) {
    return Failure{wrong_command(WireErrorKind::unknown_kind, row->form == Form::halo_sea ? 5 : 2,
                                 fmt::format("{:04X} for a control that is not known", code))};
  }
  return *command;
}

Bytes encode_command(const Command& command, bool halo) {
  Kind wanted = command.kind;
  std::uint8_t control = 0;
  if (const auto level = find_octet(kLevels, wanted)) {
    control = *level;
    wanted = Kind::gain;
  } else if (const auto antenna = find_octet(kAntenna, wanted)) {
    control = *antenna;
    wanted = Kind::antenna_height;
  } else if (const auto sea = find_octet(kHaloSea, wanted)) {
    control = *sea;
    wanted = Kind::halo_sea;
  }
  const Row* row = nullptr;
  for (const Row& each : kRows) {
    if (each.kind == wanted && (row == nullptr || halo)) row = &each;
  }
  const auto value = static_cast<std::uint32_t>(command.value);
  Bytes out(octets_of(row->form));
  put_big_endian(out, 0, row->code, 2);
  switch (row->form) {
    case Form::none:
      break;
    case Form::octet:
      put_little_endian(out, 2, value, 1);
      break;
    case Form::word:
      put_little_endian(out, 2, value, 2);
      break;
    case Form::long_word:
      put_little_endian(out, 2, value, 4);
      break;
    case Form::level:
      out[2] = control;
      out[6] = command.automatic;
      put_little_endian(out, 10, value, 1);
      break;
    case Form::halo_sea:
      out[2] = control == 2 ? 0 : control == 4 ? 1 : command.automatic;
      if (control != 1) put_little_endian(out, 4, value, 1);
      if (control == 2) put_little_endian(out, 3, value, 1);
      out[5] = control;
      break;
    case Form::sector:
    case Form::angles:
      out[2] = command.sector;
      put_little_endian(out, 6, value, 1);
      if (row->form == Form::sector) break;
      put_little_endian(out, 7, command.from, 2);
      put_little_endian(out, 9, command.to, 2);
      break;
    case Form::antenna:
      out[2] = control;
      put_little_endian(out, 6, value, 2);
      out.resize(10);
      break;
  }
  return out;
}

}  // namespace skerry::navico
