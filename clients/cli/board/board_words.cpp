#include "clients/cli/board/board_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <span>
#include <utility>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using board::BitName;
using board::Reg;

constexpr std::array<BitName, 5> kStatus = {{{board::status::running, "running"},
                                             {board::status::armed, "armed"},
                                             {board::status::captured, "captured"},
                                             {board::status::radiating, "radiating"},
                                             {board::status::fault, "fault"}}};
constexpr std::array<BitName, 4> kControl = {{{board::control::run, "run"},
                                              {board::control::reset, "reset"},
                                              {board::control::arm, "arm"},
                                              {board::control::fifo, "fifo"}}};
std::string words(std::span<const BitName> names, std::uint32_t bits) {
  std::string text;
  for (const BitName& name : names) {
    if ((bits & name.bit) != 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", name.name);
  }
  return text.empty() ? "none" : text;
}

// More values than these are not listed one by one.
constexpr std::int64_t kMostListed = 6;

// The words of a register whose values are kinds, from value 0 on.
struct Kinds {
  std::uint32_t address;
  std::array<const char*, 6> names;
};
constexpr std::array<const char*, 6> kBlanking = {"off", "trigger", "video"};
constexpr std::array<const char*, 6> kDetectors = {"log", "linear"};
constexpr std::array<const char*, 6> kPolarities = {"normal", "inverted"};
constexpr std::array<const char*, 6> kModes = {"peak", "mean", "sum"};
constexpr std::array<const char*, 6> kTests = {"off",   "ramp",   "rings",
                                               "wedge", "target", "checkerboard"};
constexpr std::array<Kinds, 9> kKinds = {
    {{board::address_of(Reg::blanking), kBlanking},
     {board::channel_address(Reg::detector_a, 0), kDetectors},
     {board::channel_address(Reg::detector_a, 1), kDetectors},
     {board::channel_address(Reg::polarity_a, 0), kPolarities},
     {board::channel_address(Reg::polarity_a, 1), kPolarities},
     {board::channel_address(Reg::decimation_mode_a, 0), kModes},
     {board::channel_address(Reg::decimation_mode_a, 1), kModes},
     {board::channel_address(Reg::test_mode_a, 0), kTests},
     {board::channel_address(Reg::test_mode_a, 1), kTests}}};

const Kinds* kinds_of(std::uint32_t address) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kinds& k) { return k.address == address; });
  return found == kKinds.end() ? nullptr : &*found;
}

// ": log, linear"; empty for other registers.
std::string kind_words(std::uint32_t address) {
  const Kinds* const kinds = kinds_of(address);
  if (!kinds) return {};
  std::string text;
  for (std::size_t i = 0; i < kinds->names.size() && kinds->names[i]; ++i) {
    text += fmt::format("{}{}", i == 0 ? ": " : ", ", kinds->names[i]);
  }
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::string name_at(std::uint32_t address) {
  const board::RegisterInfo* const info = board::find_register(address);
  return info ? std::string(info->name) : fmt::format("0x{:03X}", address);
}

}  // namespace

std::optional<std::uint32_t> parse_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  if (hex) text.remove_prefix(2);
  std::uint64_t value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (negative ? value > (kMost + 1) / 2 : value > kMost) return std::nullopt;
  return static_cast<std::uint32_t>(negative ? 0 - value : value);
}

std::string fault_words(std::uint32_t faults) { return words(board::fault_bits(), faults); }
std::string fault_label(std::uint32_t faults) {
  if (faults == 0) return {};
  std::string label = "FAULTS: " + board::fault_names(faults);
  for (char& c : label) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return label;
}
std::string status_words(std::uint32_t status) { return words(kStatus, status); }
std::string control_words(std::uint32_t control) { return words(kControl, control); }
std::string event_words(std::uint32_t events) { return words(board::event_bits(), events); }

std::string word_of(const board::RegisterInfo& info, std::uint32_t value) {
  if (const Kinds* const kinds = kinds_of(info.address)) {
    return value < kinds->names.size() && kinds->names[value] ? kinds->names[value] : "";
  }
  switch (static_cast<Reg>(info.address)) {
    case Reg::control:
      return control_words(value);
    case Reg::status:
      return status_words(value);
    case Reg::faults:
    case Reg::faults_latched:
      return fault_words(value);
    case Reg::events:
    case Reg::event_enable:
      return event_words(value);
    default:
      return {};
  }
}

std::int64_t number_of(const board::RegisterInfo& info, std::uint32_t value) {
  return info.is_signed ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value);
}

std::string range_words(const board::RegisterInfo& info) {
  return board::allowed_text(info) + kind_words(info.address);
}

Result<RegisterWrite, std::string> parse_write(std::string_view text) {
  const std::string shown = printable(text, 80);
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size()) {
    return Failure{fmt::format("'{}' is not NAME=VALUE, such as PRF_MILLIHERTZ=3000000", shown)};
  }
  const std::string_view name = text.substr(0, equals), value = text.substr(equals + 1);
  RegisterWrite write;
  if (const auto address = parse_number(name)) {
    write.address = *address;
  } else if (const board::RegisterInfo* const info = board::find_register(name)) {
    write.address = info->address;
  } else {
    return Failure{fmt::format("the board has no register '{}'; skerry board registers lists them",
                               printable(name, 40))};
  }
  if (const auto number = parse_number(value)) {
    write.value = *number;
    return write;
  }
  const Kinds* const kinds = kinds_of(write.address);
  const std::string word = lower(value);
  for (std::size_t i = 0; kinds && i < kinds->names.size() && kinds->names[i]; ++i) {
    if (word != kinds->names[i]) continue;
    write.value = static_cast<std::uint32_t>(i);
    return write;
  }
  std::string expected = "a whole number of 32 bits, decimal or with 0x";
  if (const board::RegisterInfo* const info = board::find_register(write.address)) {
    expected = fmt::format("{} ({})", expected, range_words(*info));
  }
  return Failure{fmt::format("'{}' is no value of {}; expected {}", printable(value, 40),
                             name_at(write.address), expected)};
}

std::string refusal(const RegisterWrite& write, board::RegisterError error) {
  std::string text = board::refusal_text(write.address, write.value, error);
  if (error == board::RegisterError::out_of_range) text += kind_words(write.address);
  return text;
}

std::string range_column(const board::RegisterInfo& info) {
  if (info.access != board::Access::read_write) return {};
  const std::string zero = info.or_zero ? "0, " : "";
  const std::int64_t steps = (info.max - info.min) / info.step;
  if (info.step == 1) return fmt::format("{}{} .. {}", zero, info.min, info.max);
  if (steps > kMostListed) {
    const bool even = info.step == 2 && info.min % 2 == 0;
    return fmt::format("{}{} .. {}, {}", zero, info.min, info.max,
                       even ? "even" : fmt::format("by {}", info.step));
  }
  std::string list = zero;
  for (std::int64_t n = 0; n <= steps; ++n) {
    list += fmt::format("{}{}", n == 0 ? "" : n == steps ? " or " : ", ", info.min + n * info.step);
  }
  return list;
}

std::string channel_words(const board::SweepMeta& meta, std::size_t channel) {
  const board::ChannelFormat& format = meta.channels[channel];
  if (format.samples == 0) return {};
  const double step_m = format.samples < 2 ? 0.0
                                           : board::sample_range_m(meta, channel, 1) -
                                                 board::sample_range_m(meta, channel, 0);
  std::string text =
      fmt::format("channel {}: {}, {} bit, {} samples of {:.2f} m", channel == 0 ? "A" : "B",
                  format.detector == board::Detector::log ? "log" : "linear", format.bits,
                  format.samples, step_m);
  if (format.decimation > 1) {
    text += fmt::format(" ({} of {})", kModes[static_cast<std::size_t>(format.mode) % 3],
                        format.decimation);
  }
  return format.inverted ? text + ", inverted" : text;
}

double azimuth_deg(const board::SweepMeta& meta) { return 360.0 * board::azimuth_turns(meta); }

}  // namespace skerry::client
