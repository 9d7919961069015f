#include "server/board/azimuth_counter.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

constexpr Tick kStallPeriods = 8;

std::uint32_t as_32_bits(Tick ticks) {
  return static_cast<std::uint32_t>(
      std::min<Tick>(ticks, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

std::uint32_t PulseCounts::acp_period() const {
  return acp_ticks < 2 ? 0 : as_32_bits(acp_tick - previous_acp_tick);
}

std::uint32_t PulseCounts::ticks_since_acp(Tick now) const {
  return acp_ticks == 0 ? 0 : as_32_bits(now - acp_tick);
}

void AzimuthCounter::on_trigger(Tick tick) {
  counts_.previous_trigger_tick = counts_.trigger_tick;
  counts_.trigger_tick = tick;
  ++counts_.triggers;
}

void AzimuthCounter::on_acp(Tick tick) {
  counts_.previous_acp_tick = counts_.acp_tick;
  counts_.acp_tick = tick;
  counts_.acp_ticks = std::min(counts_.acp_ticks + 1, 2u);
  ++counts_.acps;
  ++counts_.acps_since_arp;
  ++acps_without_arp_;
  faults_ &= ~board::fault::stalled;
  const Tick period = acp_seen_ ? tick - counts_.previous_acp_tick : encoder_.acp_period;
  stall_tick_ = tick + kStallPeriods * period;
  acp_seen_ = true;
  if (2 * acps_without_arp_ > 3 * std::uint64_t{encoder_.acp_per_turn}) {
    faults_ |= board::fault::arp_missing;
    turn_is_whole_ = false;
    good_turns_ = 0;
  }
}

void AzimuthCounter::on_arp(Tick tick) {
  counts_.previous_arp_tick = counts_.arp_tick;
  counts_.arp_tick = tick;
  ++counts_.arps;
  counts_.acps_per_arp = counts_.acps_since_arp;
  counts_.acps_at_arp = counts_.acps;
  counts_.triggers_at_arp = counts_.triggers;
  counts_.ticks_from_acp_to_arp = counts_.ticks_since_acp(tick);
  counts_.acps_since_arp = 0;
  acps_without_arp_ = 0;
  const bool is_good = turn_is_whole_ && counts_.acps_per_arp == encoder_.acp_per_turn;
  const Tick turn = tick - counts_.previous_arp_tick;
  counts_.turn_ticks = is_good && as_32_bits(turn) == turn ? as_32_bits(turn) : 0;
  if (turn_is_whole_) {
    const auto judged = board::fault::acp_missing | board::fault::acp_extra;
    faults_ &= ~judged;
    if (is_good) {
      faults_ &= ~board::fault::arp_missing;
      ++good_turns_;
    } else {
      faults_ |= counts_.acps_per_arp < encoder_.acp_per_turn ? board::fault::acp_missing
                                                              : board::fault::acp_extra;
      good_turns_ = 0;
    }
  }
  turn_is_whole_ = true;
}

void AzimuthCounter::reset(Tick now) {
  counts_ = {};
  faults_ = 0;
  measure_anew(now);
}

void AzimuthCounter::restart(const Encoder& encoder, Tick now, Tick new_now, bool new_clock) {
  if (encoder.acp_per_turn != encoder_.acp_per_turn) {
    counts_.acps_since_arp = scaled_to(encoder.acp_per_turn, now);
    counts_.ticks_from_acp_to_arp = 0;
  }
  encoder_ = encoder;
  if (new_clock) {
    // Ticks cannot be compared here; counts can.
    PulseCounts counts;
    counts.triggers = counts_.triggers;
    counts.acps = counts_.acps;
    counts.acps_since_arp = counts_.acps_since_arp;
    counts.arps = counts_.arps;
    counts.acps_per_arp = counts_.acps_per_arp;
    counts.acps_at_arp = counts_.acps_at_arp;
    counts.triggers_at_arp = counts_.triggers_at_arp;
    counts_ = counts;
  }
  measure_anew(new_now);
}

std::uint32_t AzimuthCounter::scaled_to(std::uint32_t acp_per_turn, Tick now) const {
  // In parts of an ACP, as azimuth_turns() has it.
  const std::uint32_t period = counts_.acp_period();
  const Wide parts = std::max(period, 1u);
  const Wide count = counts_.acps_since_arp * parts +
                     std::min(counts_.ticks_since_acp(now), period) -
                     std::min(counts_.ticks_from_acp_to_arp, period);
  const Wide scaled = std::max<Wide>(count, 0) * acp_per_turn / (encoder_.acp_per_turn * parts);
  return static_cast<std::uint32_t>(
      std::min<Wide>(scaled, std::numeric_limits<std::uint32_t>::max()));
}

void AzimuthCounter::measure_anew(Tick now) {
  counts_.turn_ticks = 0;
  good_turns_ = 0;
  turn_is_whole_ = false;
  acps_without_arp_ = 0;
  acp_seen_ = false;
  stall_tick_ = now + kStallPeriods * encoder_.acp_period;
}

void AzimuthCounter::skip(std::uint64_t turns, std::uint64_t triggers) {
  counts_.triggers += triggers;
  counts_.acps += turns * encoder_.acp_per_turn;
  counts_.arps += static_cast<std::uint32_t>(turns);
  stall_tick_ = kNever;
  acp_seen_ = false;
}

}  // namespace skerry::server
