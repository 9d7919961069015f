// Registers, faults and events in words.
#include <fmt/format.h>

#include <array>

#include "protocol/board/registers.hpp"

namespace skerry::board {
namespace {

constexpr std::array<BitName, 7> kFaultNames = {{{fault::config, "config"},
                                                 {fault::acp_missing, "acp_missing"},
                                                 {fault::acp_extra, "acp_extra"},
                                                 {fault::arp_missing, "arp_missing"},
                                                 {fault::stalled, "stalled"},
                                                 {fault::overrun, "overrun"},
                                                 {fault::late, "late"}}};

constexpr std::array<BitName, 7> kEventNames = {{{event::arp, "arp"},
                                                 {event::heading, "heading"},
                                                 {event::fault_raised, "fault_raised"},
                                                 {event::fault_cleared, "fault_cleared"},
                                                 {event::captured, "captured"},
                                                 {event::configured, "configured"},
                                                 {event::reset, "reset"}}};

bool is_source(std::uint32_t address) {
  return address == address_of(Reg::source_a) || address == address_of(Reg::source_b);
}

}  // namespace

std::span<const BitName> fault_bits() { return kFaultNames; }
std::span<const BitName> event_bits() { return kEventNames; }

std::string fault_names(std::uint32_t faults) {
  std::string names;
  const auto add = [&](std::string_view name) { (names += names.empty() ? "" : ", ") += name; };
  for (const BitName& each : kFaultNames) {
    if ((faults & each.bit) != 0) add(each.name);
    faults &= ~each.bit;
  }
  if (faults != 0) add(fmt::format("0x{:X}", faults));
  return names;
}

std::string_view event_name(std::uint32_t event) {
  for (const BitName& each : kEventNames) {
    if (each.bit == event) return each.name;
  }
  return "unknown";
}

std::string allowed_text(const RegisterInfo& info) {
  return fmt::format("{}{} to {}{}{}{}", info.or_zero ? "0, or " : "", info.min, info.max,
                     info.unit.empty() ? "" : " ", info.unit,
                     info.step > 1 ? fmt::format(" in steps of {}", info.step) : "");
}

std::string refusal_text(std::uint32_t address, std::uint32_t value, RegisterError error) {
  const RegisterInfo* const info = find_register(address);
  const std::string name =
      info ? std::string(info->name) : fmt::format("register 0x{:03X}", address);
  switch (error) {
    case RegisterError::ok:
      return {};
    case RegisterError::read_only:
      return fmt::format("{} is read only", name);
    case RegisterError::misaligned:
      return fmt::format("0x{:X} is no address of a register: they are multiples of 4", address);
    case RegisterError::unknown_register:
      return fmt::format("the board has no register at 0x{:X}", address);
    case RegisterError::out_of_range:
      break;
  }
  if (!info) return fmt::format("{}: 0x{:X} is out of range", name, value);
  if (is_source(address) && check_write(address, value) == RegisterError::ok) {
    return fmt::format(
        "{}: no radar {} on this own ship; allowed: 0, or a radar of the same own ship + 1", name,
        std::int64_t{value} - 1);
  }
  return fmt::format("{}: {} is out of range; allowed: {}", name, value_of(*info, value),
                     allowed_text(*info));
}

}  // namespace skerry::board
