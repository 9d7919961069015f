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
  std::uint32_t acp_ticks = 0;  // of these two that are of this clock
  std::uint32_t acps_since_arp = 0;
  std::uint32_t arps = 0;
  Tick arp_tick = 0, previous_arp_tick = 0;
  std::uint32_t acps_per_arp = 0;  // of the last whole turn
  std::uint32_t turn_ticks =
      0;  // of the last turn, if it had the right number of ACPs and they fit; else 0
  std::uint64_t acps_at_arp = 0, triggers_at_arp = 0;
  std::uint32_t ticks_from_acp_to_arp = 0;

  // Between the last two ACPs; 0: there were none.  What exceeds 32 bits is their most.
  std::uint32_t acp_period() const;
  // 0: there was none.  As above.
  std::uint32_t ticks_since_acp(Tick now) const;
};

// The encoder as configured.
struct Encoder {
  std::uint32_t acp_per_turn = 4096;
  Tick acp_period = 12'207;  // of an antenna that turns evenly
};

// Knows pulses and what is configured, never how the antenna truly turns.  Faults:
//   acp_missing, acp_extra  a turn had too few or too many; until a turn has the right number
//   arp_missing             1.5 turns of ACPs without one, since the last or since counting began
//                           or the settings changed; until the next turn of the right number
//   stalled                 8 of the last period without an ACP, or of the configured one where
//                           none is known yet; until the next ACP
// A turn that ends an arp_missing is not judged by its ACPs.  Nor is the one in which counting
// began, or the settings changed.
class AzimuthCounter {
 public:
  // Counting begins at tick 0.
  explicit AzimuthCounter(const Encoder& encoder) : encoder_(encoder) { measure_anew(0); }

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
  void reset(Tick now);
  // Other settings from `now` on, which is `new_now` of the new clock: the turn in progress is
  // judged no more.  new_clock: ticks known so far are of another clock, and forgotten.  With
  // another number of ACPs the count since the ARP is put into those, so that the azimuth stays
  // true to two of them, and from the second that comes to one, up to the next ARP; on a new clock
  // it is unknown up to the second.  All other counts are of pulses that came and stay.
  void restart(const Encoder& encoder, Tick now, Tick new_now, bool new_clock);
  // Counts so many good turns with that many triggers, without their pulses.  Ticks stay as they
  // were until a turn and two triggers have come.
  void skip(std::uint64_t turns, std::uint64_t triggers);

 private:
  void measure_anew(Tick now);
  std::uint32_t scaled_to(std::uint32_t acp_per_turn, Tick now) const;

  Encoder encoder_;
  PulseCounts counts_;
  std::uint32_t faults_ = 0;
  std::uint32_t good_turns_ = 0;
  bool turn_is_whole_ = false;          // since an ARP
  std::uint64_t acps_without_arp_ = 0;  // since measuring began
  bool acp_seen_ = false;               // since measuring began; the next one ends a period
  Tick stall_tick_ = kNever;
};

}  // namespace skerry::server
