// AzimuthCounter: what a digitiser makes of the pulses that reach it.
#pragma once

#include <limits>

#include "protocol/board/registers.hpp"
#include "server/board/tick_clock.hpp"

namespace skerry::server {

// Everything counted since the last reset, as registers and records show it.
struct PulseCounts {
  std::uint64_t triggers = 0;
  Tick trigger_tick = 0, previous_trigger_tick = 0;
  std::uint64_t acps = 0;
  Tick acp_tick = 0, previous_acp_tick = 0;
  std::uint32_t acps_since_arp = 0;
  std::uint32_t arps = 0;
  Tick arp_tick = 0, previous_arp_tick = 0;
  std::uint32_t acps_per_arp = 0;  // of the last whole turn
  std::uint32_t turn_ticks = 0;    // of the last turn, if it had the right number of ACPs; else 0
  std::uint64_t acps_at_arp = 0, triggers_at_arp = 0;
  std::uint32_t ticks_from_acp_to_arp = 0;

  // Between the last two ACPs; 0: there were none.
  std::uint32_t acp_period() const;
  // 0: there was none.
  std::uint32_t ticks_since_acp(Tick now) const;
};

// Knows pulses and the configured number of ACPs, never how the antenna truly turns.  Faults:
//   acp_missing, acp_extra  a turn had too few or too many; until a turn has the right number
//   arp_missing             1.5 turns of ACPs without one; until the next turn of the right number
//   stalled                 8 of the last period without an ACP; until the next ACP
// A turn that ends an arp_missing is not judged by its ACPs.  Nor is the one in which counting
// began, or the settings changed.
class AzimuthCounter {
 public:
  explicit AzimuthCounter(std::uint32_t acp_per_turn) : acp_per_turn_(acp_per_turn) {}

  // Pulses in order of time.
  void on_trigger(Tick tick);
  void on_acp(Tick tick);
  void on_arp(Tick tick);
  // No ACP has come until stall_tick().
  void on_stall() { faults_ |= board::fault::stalled; }
  Tick stall_tick() const { return (faults_ & board::fault::stalled) == 0 ? stall_tick_ : kNever; }
  static constexpr Tick kNever = std::numeric_limits<Tick>::max();

  const PulseCounts& counts() const { return counts_; }
  std::uint32_t faults() const { return faults_; }
  // The last two turns had the right number.
  bool steady() const { return good_turns_ >= 2 && faults_ == 0; }

  // Counts and faults to 0.
  void reset();
  // Other settings: the turn in progress is judged no more.  new_clock: ticks are of another clock.
  void restart(std::uint32_t acp_per_turn, bool new_clock);
  // As if so many good turns with that many triggers had been counted.  Ticks stay those of before,
  // until a turn and two triggers have come.
  void skip(std::uint64_t turns, std::uint64_t triggers);

 private:
  void measure_anew();

  std::uint32_t acp_per_turn_;
  PulseCounts counts_;
  std::uint32_t faults_ = 0;
  std::uint32_t good_turns_ = 0;
  bool turn_is_whole_ = false;  // since an ARP
  bool acp_seen_ = false;       // since measuring began; the next one ends a period
  Tick stall_tick_ = kNever;
};

}  // namespace skerry::server
