// The page of an open digitiser's registers, in terms of the board's own.
#include "server/board/register_file.hpp"

namespace skerry::server {
namespace {

using board::Digdar;
using board::DigdarUse;
using board::Reg;
using board::RegisterError;

constexpr std::uint32_t low_14_bits(Tick tick) { return static_cast<std::uint32_t>(tick & 0x3FFF); }

constexpr std::uint32_t word_of(Digdar offset) { return static_cast<std::uint32_t>(offset) / 4; }
constexpr std::uint32_t half_of(std::uint64_t value, bool high) {
  return static_cast<std::uint32_t>(high ? value >> 32 : value);
}

}  // namespace

RegisterError RegisterFile::write_digdar(const board::DigdarRegister& row, std::uint32_t value) {
  const std::uint32_t offset = row.info->address - board::kDigdarPage;
  if (row.use == DigdarUse::same) return write(board::address_of(*row.reg), value);
  if (row.use != DigdarUse::converted) {
    digdar_words_[offset / 4] = value;
    return RegisterError::ok;
  }
  switch (static_cast<Digdar>(offset)) {
    case Digdar::command: {
      std::uint32_t bits = 0;
      if ((value & board::digdar_command::reset) != 0) bits |= board::control::reset;
      const bool source = digdar_words_[word_of(Digdar::trig_source)] != 0;
      if ((value & board::digdar_command::arm) != 0 && source) bits |= board::control::arm;
      command(bits);
      break;
    }
    case Digdar::options: {
      const bool mean = (value & board::digdar_option::average) != 0;
      const bool sum = (value & board::digdar_option::sum) != 0;
      const auto mode = sum    ? board::DecimationMode::sum
                        : mean ? board::DecimationMode::mean
                               : board::DecimationMode::peak;
      stored(Reg::decimation_mode_a) = static_cast<std::uint32_t>(mode);
      stored(Reg::polarity_a) = (value & board::digdar_option::negate) != 0 ? 1 : 0;
      const bool counting = (value & board::digdar_option::counting) != 0;
      stored(Reg::test_mode_a) =
          static_cast<std::uint32_t>(counting ? board::TestMode::ramp : board::TestMode::off);
      changed_ = true;
      break;
    }
    default:
      digdar_words_[offset / 4] = value;
      break;
  }
  return RegisterError::ok;
}

std::uint32_t RegisterFile::digdar_value(const board::DigdarRegister& row) const {
  const std::uint32_t offset = row.info->address - board::kDigdarPage;
  switch (row.use) {
    case DigdarUse::same:
      return value_of(board::address_of(*row.reg));
    case DigdarUse::stored:
      return digdar_words_[offset / 4];
    case DigdarUse::zero:
      return 0;
    case DigdarUse::pulses:
      return offset >= board::kDigdarAtTrigger
                 ? digdar_pulses(offset - board::kDigdarAtTrigger + board::kDigdarMetadata,
                                 state_.latched.counts)
                 : digdar_pulses(offset, state_.counts);
    case DigdarUse::converted:
      break;
  }
  constexpr auto kAdcCounter = static_cast<std::uint32_t>(Digdar::adc_counter);
  if (offset == kAdcCounter) return low_14_bits(state_.clocks);
  if (offset == kAdcCounter + board::kDigdarAtTrigger - board::kDigdarMetadata) {
    return low_14_bits(state_.latched.counts.trigger_tick);
  }
  switch (static_cast<Digdar>(offset)) {
    case Digdar::command:
      return 0;
    case Digdar::options: {
      std::uint32_t bits = 0;
      const auto mode = static_cast<board::DecimationMode>(stored(Reg::decimation_mode_a));
      if (mode == board::DecimationMode::mean) bits |= board::digdar_option::average;
      if (mode == board::DecimationMode::sum) bits |= board::digdar_option::sum;
      if (stored(Reg::polarity_a) != 0) bits |= board::digdar_option::negate;
      if (stored(Reg::test_mode_a) == static_cast<std::uint32_t>(board::TestMode::ramp)) {
        bits |= board::digdar_option::counting;
      }
      return bits;
    }
    default:
      return digdar_words_[offset / 4];
  }
}

std::uint32_t RegisterFile::digdar_pulses(std::uint32_t offset, const PulseCounts& counts) const {
  const bool high = offset % 8 == 4;
  switch (static_cast<Digdar>(offset & ~std::uint32_t{4})) {
    case Digdar::trig_clock:
      return half_of(counts.trigger_tick, high);
    case Digdar::trig_prev_clock:
      return half_of(counts.previous_trigger_tick, high);
    case Digdar::acp_clock:
      return half_of(counts.acp_tick, high);
    case Digdar::acp_prev_clock:
      return half_of(counts.previous_acp_tick, high);
    case Digdar::arp_clock:
      return half_of(counts.arp_tick, high);
    case Digdar::arp_prev_clock:
      return half_of(counts.previous_arp_tick, high);
    default:
      break;
  }
  switch (static_cast<Digdar>(offset)) {
    case Digdar::acp_count:
      return static_cast<std::uint32_t>(counts.acps);
    case Digdar::acp_per_arp:
      return counts.acps_per_arp;
    case Digdar::acp_at_arp:
      return static_cast<std::uint32_t>(counts.acps_at_arp);
    case Digdar::clock_since_acp_at_arp:
      return counts.ticks_from_acp_to_arp;
    case Digdar::trig_at_arp:
      return static_cast<std::uint32_t>(counts.triggers_at_arp);
    default:
      return 0;
  }
}

}  // namespace skerry::server
