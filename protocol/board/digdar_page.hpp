// The registers of an open digitiser of marine radars (digdar, github.com/jbrzusto/ogdar), which
// the board answers for at kDigdarPage.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/board/registers.hpp"

namespace skerry::board {

// Offsets in the page.  A 64-bit value stands in two registers, low half first.
// Source: BOARD.md "Sources" (fpga/fpga.go of that project: Control, Metadata, Live, AtTrig).
enum class Digdar : std::uint32_t {
  command = 0x00,
  trig_source = 0x04,
  num_samp = 0x08,
  dec_rate = 0x0C,
  options = 0x10,
  trig_thresh_excite = 0x14,
  trig_thresh_relax = 0x18,
  trig_delay = 0x1C,
  trig_latency = 0x20,
  acp_thresh_excite = 0x24,
  acp_thresh_relax = 0x28,
  acp_latency = 0x2C,
  arp_thresh_excite = 0x30,
  arp_thresh_relax = 0x34,
  arp_latency = 0x38,

  // Present values; from kDigdarAtTrigger on the same registers again, as they were at the trigger
  // of the last sweep captured.
  trig_clock = 0x40,
  trig_prev_clock = 0x48,
  acp_clock = 0x50,
  acp_prev_clock = 0x58,
  arp_clock = 0x60,
  arp_prev_clock = 0x68,
  trig_count = 0x70,
  acp_count = 0x74,  // since the reset, not since the ARP
  arp_count = 0x78,
  acp_per_arp = 0x7C,
  adc_counter = 0x80,
  acp_at_arp = 0x84,
  clock_since_acp_at_arp = 0x88,
  trig_at_arp = 0x8C,

  clocks = 0x90,
  acp_raw = 0x98,
  arp_raw = 0x9C,
};
inline constexpr std::uint32_t kDigdarMetadata = 0x40;   // its first offset
inline constexpr std::uint32_t kDigdarAtTrigger = 0xA0;  // of the first one latched
inline constexpr std::uint32_t kDigdarBytes = 0xF0;      // of the page

namespace digdar_command {
inline constexpr std::uint32_t arm = 1u << 0;
inline constexpr std::uint32_t reset = 1u << 1;
}  // namespace digdar_command

namespace digdar_option {
inline constexpr std::uint32_t average = 1u << 0;
inline constexpr std::uint32_t sum = 1u << 1;
inline constexpr std::uint32_t negate = 1u << 2;
inline constexpr std::uint32_t counting = 1u << 3;
}  // namespace digdar_option

constexpr std::uint32_t address_of(Digdar offset) {
  return kDigdarPage + static_cast<std::uint32_t>(offset);
}

// How the board stands in for a register of the page.
enum class DigdarUse : std::uint8_t {
  same,       // reads and writes `reg`
  converted,  // reads and writes `reg` and what belongs to it, as `info->what` says
  pulses,     // counted from the pulses; the board's own map has no such register
  stored,     // reads what was written; without effect: pulses here have no shape to be detected
  zero,       // always 0
};

struct DigdarRegister {
  const RegisterInfo* info = nullptr;  // its name begins with "DIGDAR_"
  DigdarUse use = DigdarUse::zero;
  std::optional<Reg> reg;  // `same` and `converted`
};

// Ascending by address.  find_register() and check_write() know them, too.
std::span<const DigdarRegister> digdar_page();
std::span<const RegisterInfo> digdar_infos();
// Finds a register by its address, in [kDigdarPage, kDigdarPage + kDigdarBytes).
const DigdarRegister* find_digdar(std::uint32_t address);

}  // namespace skerry::board
