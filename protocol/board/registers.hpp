// The register map of the interface board: addresses, what may be written, and why not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skerry::board {

// Byte addresses of 32-bit registers.  A 64-bit value stands in two, low half first; a batch of
// accesses is carried out at one instant, so both halves belong together.
enum class Reg : std::uint32_t {
  // Identity.
  identity = 0x000,  // "SKRB" in ASCII, first letter lowest
  version = 0x004,   // of this map
  radar = 0x008,     // index in the server
  pulse_codes = 0x00C,

  // Control and state.
  control = 0x010,         // ControlBit
  status = 0x014,          // StatusBit
  faults = 0x018,          // FaultBit, as they are now
  faults_latched = 0x01C,  // FaultBit, until a 1 is written
  events = 0x020,          // EventBit, until a 1 is written
  event_enable = 0x024,    // those that are also sent as records
  fault_reason = 0x080,    // ASCII, 128 bytes, 0 at the end: why the fault `config` is set

  // Time.
  sample_clock_hz = 0x100,
  clocks_low = 0x104,  // ticks of the sample clock since scenario time 0
  clocks_high = 0x108,
  utc_ns_low = 0x10C,
  utc_ns_high = 0x110,

  // Trigger generator.
  pulse_code = 0x120,      // 0: as the radar has it on the air; n: the set's n-th pulse
  prf_millihertz = 0x124,  // 0: the pulse's own
  jitter_ppm = 0x128,      // of the period, uniform to either side
  stagger_ppm = 0x12C,     // of the period: + and - by turns
  trigger_delay = 0x130,   // ticks from the trigger to the first sample; range zero is the trigger
  blanking = 0x134,        // BlankingMode
  blank_1_from = 0x138,    // tenths of a degree from the bow, clockwise to the next
  blank_1_to = 0x13C,
  blank_2_from = 0x140,
  blank_2_to = 0x144,

  // Azimuth generator.
  acp_per_turn = 0x160,
  rotation_millirpm = 0x164,  // 0: the radar's own
  arp_error = 0x168,          // signed, 1/65536 turn: where the ARP comes, clockwise from the bow
  wow_ppm = 0x16C,            // of the speed, largest deviation
  wow_per_turn = 0x170,       // waves in a turn
  gust_ppm = 0x174,           // of the speed, largest deviation; once a turn, its strength varying

  // Faults injected; a write sets how many are still to come (0: none), reading gives that.
  inject_missing_acp = 0x180,  // pulses left out, one in 16
  inject_extra_acp = 0x184,    // pulses too many, one after every 16th
  inject_missing_arp = 0x188,  // turns
  inject_stall_ms = 0x18C,     // the antenna stands still, from the next ACP on, or as it does

  // Sweeps.
  fifo_depth = 0x1A0,       // samples, of both channels together
  fifo_level = 0x1A4,       // sweeps in it
  spokes_per_turn = 0x1A8,  // 0: every trigger is a record; else pulses are integrated by azimuth
  overruns_a = 0x1B0,       // sweeps that the FIFO had no room for
  underruns_a = 0x1B4,      // sweeps asked of an empty FIFO
  overruns_b = 0x1B8,
  underruns_b = 0x1BC,
  sweeps_late = 0x1C0,  // never made: the board was too far behind

  // Video channels; B as A, kChannelStride further on.
  source_a = 0x200,           // 0: off; n: radar n - 1 of the same own ship
  detector_a = 0x204,         // Detector
  bits_a = 0x208,             // 8, 10, 12 or 14
  polarity_a = 0x20C,         // 1: strongest echo is 0
  gain_a = 0x210,             // signed, 1/100 dB
  offset_a = 0x214,           // signed, steps of the converter
  stc_a = 0x218,              // 0 .. 100, as the sea control
  samples_a = 0x21C,          // of a sweep, after decimation; even
  decimation_a = 0x220,       // samples of the clock to one of the sweep
  decimation_mode_a = 0x224,  // DecimationMode
  test_mode_a = 0x228,        // TestMode
  test_value_a = 0x22C,       // samples between rings, wedge or tile width, range of the target

  source_b = 0x240,
  test_value_b = 0x26C,

  // Counted as the board sees the pulses.
  trigger_count_low = 0x300,
  trigger_count_high = 0x304,
  acp_count = 0x308,  // since the last ARP
  arp_count = 0x30C,
  acp_per_arp = 0x310,  // of the last whole turn

  // The same as they were at the trigger of the last sweep captured.
  latched_trigger_count_low = 0x340,
  latched_trigger_count_high = 0x344,
  latched_clock_low = 0x348,
  latched_clock_high = 0x34C,
  latched_acp_count = 0x350,
  latched_ticks_since_acp = 0x354,
  latched_acp_period = 0x358,
  latched_arp_count = 0x35C,
  latched_utc_ns_low = 0x360,
  latched_utc_ns_high = 0x364,
};

inline constexpr std::uint32_t kChannelStride = 0x40;
inline constexpr std::uint32_t kIdentity = 0x42524B53;  // "SKRB"
inline constexpr std::uint32_t kMapVersion = 1;
inline constexpr std::uint32_t kFaultReasonBytes = 128;

// The registers of an open digitiser of marine radars (digdar) at their own offsets, from here on.
inline constexpr std::uint32_t kDigdarPage = 0x1000;

constexpr std::uint32_t address_of(Reg reg) { return static_cast<std::uint32_t>(reg); }
// The register of channel 0 (A) or 1 (B), given A's.
constexpr std::uint32_t channel_address(Reg of_a, std::uint32_t channel) {
  return address_of(of_a) + channel * kChannelStride;
}

namespace control {
inline constexpr std::uint32_t run = 1u << 0;    // triggers are captured as they come
inline constexpr std::uint32_t reset = 1u << 1;  // counts, FIFO, faults to 0; reads 0
inline constexpr std::uint32_t arm = 1u << 2;    // capture the next trigger into the FIFO; reads 0
inline constexpr std::uint32_t fifo = 1u << 3;  // while running, captured sweeps go to the FIFO too
}  // namespace control

namespace status {
inline constexpr std::uint32_t running = 1u << 0;
inline constexpr std::uint32_t armed = 1u << 1;
inline constexpr std::uint32_t captured = 1u << 2;   // since it was last armed
inline constexpr std::uint32_t radiating = 1u << 3;  // the radar transmits
inline constexpr std::uint32_t fault = 1u << 4;      // some bit of `faults`
}  // namespace status

namespace fault {
inline constexpr std::uint32_t config = 1u << 0;       // settings contradict each other
inline constexpr std::uint32_t acp_missing = 1u << 1;  // the last turn had too few
inline constexpr std::uint32_t acp_extra = 1u << 2;    // too many
inline constexpr std::uint32_t arp_missing = 1u << 3;  // none within 1.5 turns of ACPs
inline constexpr std::uint32_t stalled = 1u << 4;      // no ACP for 8 of their periods
inline constexpr std::uint32_t overrun = 1u << 5;      // the FIFO has no room for a sweep
inline constexpr std::uint32_t late = 1u << 6;         // sweeps had to be left out
}  // namespace fault

// A record kEvent has one of these.
namespace event {
inline constexpr std::uint32_t arp = 1u << 0;
inline constexpr std::uint32_t heading = 1u << 1;  // the antenna passed the bow
inline constexpr std::uint32_t fault_raised = 1u << 2;
inline constexpr std::uint32_t fault_cleared = 1u << 3;
inline constexpr std::uint32_t captured = 1u << 4;
inline constexpr std::uint32_t configured = 1u << 5;  // other settings are in force
inline constexpr std::uint32_t reset = 1u << 6;
}  // namespace event

enum class Detector : std::uint32_t { log = 0, linear = 1 };
enum class DecimationMode : std::uint32_t { peak = 0, mean = 1, sum = 2 };
enum class BlankingMode : std::uint32_t { off = 0, trigger = 1, video = 2 };
enum class TestMode : std::uint32_t {
  off = 0,
  ramp = 1,          // sample i of trigger t reads i + t
  rings = 2,         // every test_value samples
  wedge = 3,         // test_value tenths of a degree wide, from the ARP on
  target = 4,        // one point at test_value samples, over the ARP
  checkerboard = 5,  // tiles of test_value samples and 1/32 turn
};

// The board's answer to an access.
enum class RegisterError : std::uint32_t {
  ok = 0,
  unknown_register = 1,
  read_only = 2,
  out_of_range = 3,
  misaligned = 4,
};
std::string_view name_of(RegisterError error);

enum class Access : std::uint8_t { read_only, read_write, write_ones_to_clear };

struct RegisterInfo {
  std::uint32_t address = 0;
  std::string_view name;  // "PRF_MILLIHERTZ"
  Access access = Access::read_only;
  bool is_signed = false;  // two's complement
  std::int64_t min = 0, max = 0;
  std::int64_t reset = 0;  // at the start; control::reset leaves settings as they are
  std::string_view unit;
  std::string_view what;   // one line
  std::uint32_t step = 1;  // a value is min + a multiple of it
  bool or_zero = false;    // 0 may be written although min is more
};

// Ascending.  fault_reason and the digdar page are not in it, one register by one, but found, as
// FAULT_REASON_0 .. FAULT_REASON_31 and DIGDAR_COMMAND and so on (digdar_page.hpp).
std::span<const RegisterInfo> all_registers();
const RegisterInfo* find_register(std::uint32_t address);
// Letters of either case.
const RegisterInfo* find_register(std::string_view name);

// Whether `value` may be written there, by this register alone: what it means beside the others is
// the board's to judge (fault `config`).  A write_ones_to_clear register takes any value: bits that
// it does not have are ignored.
RegisterError check_write(std::uint32_t address, std::uint32_t value);

// "0, or 10000 to 20000000 mHz".
std::string allowed_text(const RegisterInfo& info);
// Why a write was refused, as a sentence: what was wrong, and what is allowed.  Empty for `ok`.
std::string refusal_text(std::uint32_t address, std::uint32_t value, RegisterError error);

// Bits by their names, as BOARD.md 3.1 has them, lowest first.
struct BitName {
  std::uint32_t bit = 0;
  std::string_view name;
};
std::span<const BitName> fault_bits();
std::span<const BitName> event_bits();
// "acp_missing, stalled"; bits without a name as a number; empty for none.
std::string fault_names(std::uint32_t faults);
// The name of one bit; "unknown" for others.
std::string_view event_name(std::uint32_t event);

// The value of a register as a number: two's complement where it is signed.
constexpr std::int64_t value_of(const RegisterInfo& info, std::uint32_t bits) {
  return info.is_signed ? static_cast<std::int32_t>(bits) : std::int64_t{bits};
}

// The four characters of `reason` that the n-th register of fault_reason reads, the first lowest.
// Characters beyond kFaultReasonBytes - 1 are left out; what is not printable ASCII reads '?'.
std::uint32_t fault_reason_word(std::string_view reason, std::uint32_t n);
// Back again from the registers, in their order.
std::string fault_reason_text(std::span<const std::uint32_t> words);

}  // namespace skerry::board
