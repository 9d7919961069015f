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
  return acps < 2 ? 0 : as_32_bits(acp_tick - previous_acp_tick);
}

std::uint32_t PulseCounts::ticks_since_acp(Tick now) const {
  return acps == 0 ? 0 : as_32_bits(now - acp_tick);
}

void AzimuthCounter::on_trigger(Tick tick) {
  counts_.previous_trigger_tick = counts_.trigger_tick;
  counts_.trigger_tick = tick;
  ++counts_.triggers;
}

void AzimuthCounter::on_acp(Tick tick) {
  counts_.previous_acp_tick = counts_.acp_tick;
  counts_.acp_tick = tick;
  ++counts_.acps;
  ++counts_.acps_since_arp;
  faults_ &= ~board::fault::stalled;
  if (acp_seen_) stall_tick_ = tick + kStallPeriods * (tick - counts_.previous_acp_tick);
  acp_seen_ = true;
  if (turn_is_whole_ &&
      2 * std::uint64_t{counts_.acps_since_arp} > 3 * std::uint64_t{acp_per_turn_}) {
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
  counts_.turn_ticks = turn_is_whole_ && counts_.acps_per_arp == acp_per_turn_
                           ? as_32_bits(tick - counts_.previous_arp_tick)
                           : 0;
  if (turn_is_whole_) {
    const auto judged = board::fault::acp_missing | board::fault::acp_extra;
    faults_ &= ~judged;
    if (counts_.acps_per_arp == acp_per_turn_) {
      faults_ &= ~board::fault::arp_missing;
      ++good_turns_;
    } else {
      faults_ |= counts_.acps_per_arp < acp_per_turn_ ? board::fault::acp_missing
                                                      : board::fault::acp_extra;
      good_turns_ = 0;
    }
  }
  turn_is_whole_ = true;
}

void AzimuthCounter::reset() {
  counts_ = {};
  faults_ = 0;
  measure_anew();
}

void AzimuthCounter::restart(std::uint32_t acp_per_turn, bool new_clock) {
  acp_per_turn_ = acp_per_turn;
  if (new_clock) {
    // Of the ticks none is comparable; the counts are.
    PulseCounts counts;
    counts.triggers = counts_.triggers;
    counts.acps_since_arp = counts_.acps_since_arp;
    counts.arps = counts_.arps;
    counts.acps_per_arp = counts_.acps_per_arp;
    counts_ = counts;
  }
  measure_anew();
}

void AzimuthCounter::measure_anew() {
  counts_.turn_ticks = 0;
  good_turns_ = 0;
  turn_is_whole_ = false;
  acp_seen_ = false;
  stall_tick_ = kNever;
}

void AzimuthCounter::skip(std::uint64_t turns, std::uint64_t triggers) {
  counts_.triggers += triggers;
  counts_.acps += turns * acp_per_turn_;
  counts_.arps += static_cast<std::uint32_t>(turns);
  stall_tick_ = kNever;
  acp_seen_ = false;
}

}  // namespace skerry::server
