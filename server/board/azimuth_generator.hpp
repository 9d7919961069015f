// AzimuthGenerator: how the antenna turns, and the pulses that its encoder sends.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "protocol/board/sweep_record.hpp"
#include "server/board/azimuth.hpp"
#include "server/board/tick_clock.hpp"

namespace skerry::server {

struct RotationSettings {
  std::uint32_t clock_hz = 20'000'000;
  std::uint32_t milli_rpm = 24'000;
  std::uint32_t acp_per_turn = 4096;
  std::int32_t arp_error = 0;  // 1/65536 turn: where the ARP comes, clockwise from the bow
  std::uint32_t wow_ppm = 0, wow_per_turn = 1, gust_ppm = 0;
  std::uint64_t seed = 0;  // of the gusts
  friend bool operator==(const RotationSettings&, const RotationSettings&) = default;
};

// Faults still to be sent.
struct AzimuthFaults {
  std::uint32_t missing_acp = 0, extra_acp = 0, missing_arp = 0;
  Tick stall = 0;
  bool none() const { return missing_acp == 0 && extra_acp == 0 && missing_arp == 0 && stall == 0; }
};

// Faults to send from now on, in place of those still to come; an absent one stays as it is.
struct AzimuthOrders {
  std::optional<std::uint32_t> missing_acp = {}, extra_acp = {}, missing_arp = {};
  std::optional<Tick> stall = {};
};

// The lines that an encoder drives.
enum class AzimuthLine : std::uint8_t { acp, arp, heading };
constexpr board::Line line_of(AzimuthLine line) {
  return line == AzimuthLine::acp   ? board::Line::acp
         : line == AzimuthLine::arp ? board::Line::arp
                                    : board::Line::heading;
}

// The time of an azimuth (in turns) is origin + azimuth * turn + displacement.  Undisturbed, with
// the bow at tick 0, that is the rational of echo::SpokeClock to half a tick, for ever.  Wow and
// gusts are displacements, functions of the azimuth alone, and so never add up:
//   wow   -T a / (2 pi m) sin(2 pi m azimuth), a = w / (1 + w): the speed deviates by w at most
//   gust   T a u / (2 pi) (cos(2 pi azimuth) - 1), u of each turn in [0, 1): less than w
// Both leave the bow's time and the order of all azimuths as they are.  Sine by exact_math, so the
// ticks are the same on every machine.
//
// Pulses: ACP k at k / acp_per_turn, heading over the bow, ARP at arp_error.  Faults change what is
// sent (one ACP in 16 left out; one too many midway behind every 16th; no ARP), but for a stall,
// which is the antenna's: from an ACP on it stands there, and what follows is as much later.
class AzimuthGenerator {
 public:
  explicit AzimuthGenerator(const RotationSettings& settings);

  // The antenna goes on from where it points at `now`, tick `new_now` of the new clock.
  void set(const RotationSettings& settings, Tick now, Tick new_now);
  const RotationSettings& settings() const { return settings_; }

  struct Pulse {
    Tick tick = 0;
    AzimuthLine line = AzimuthLine::acp;
    bool sent = true;  // false: left out
  };
  // In order of azimuth, and so of ticks.  At one azimuth: ACP, ARP, heading.
  const Pulse& next() const { return next_; }
  void pop();

  // The antenna's direction.  Error: 2^-16 tick of time; it does not grow with the number of calls.
  Azimuth at(Tick tick) const;
  // The first tick at which it points there or further.
  Tick first_tick(Azimuth azimuth) const;

  // A stall in progress at `now` ends as long after it as `stall` says.
  void inject(const AzimuthOrders& orders, Tick now);
  // Drops the faults to come; a stall in progress ends when it would have.
  void forget_faults();
  // A stall in progress counts as far as it is still to last.
  AzimuthFaults left(Tick now) const;
  bool disturbed(Tick now) const { return !faults_.none() || now < stalled_until_; }

  // Skips that many turns, as if they had been popped.  Requires !disturbed().
  void skip_turns(std::uint64_t turns);

 private:
  // Exact: numerator / denominator turns.
  struct Ratio {
    Wide numerator = 0, denominator = 1;
  };
  static std::strong_ordering compare(const Ratio& a, const Ratio& b) {
    return a.numerator * b.denominator <=> b.numerator * a.denominator;
  }
  Ratio acp() const { return {static_cast<Wide>(half_acp_), 2 * Wide{settings_.acp_per_turn}}; }
  Ratio arp() const {
    return {static_cast<Wide>(arp_turn_) * 65'536 + settings_.arp_error, 65'536};
  }
  Ratio heading() const { return {static_cast<Wide>(heading_turn_), 1}; }

  bool is_disturbed_in_speed() const { return settings_.wow_ppm != 0 || settings_.gust_ppm != 0; }
  // Ticks, and fine ticks of the turn at which it is `fraction` behind the bow.
  double displacement(std::uint64_t turn, double fraction) const;
  double displacement_slope(std::uint64_t turn, double fraction) const;
  Wide fine_tick(const Ratio& azimuth) const;
  Wide fine_tick(Azimuth azimuth) const;
  // Undisturbed, `fine` ticks after the origin.
  Azimuth even_azimuth(Wide fine) const;
  void set_origin(Azimuth azimuth, Tick now);
  void find_next();

  RotationSettings settings_;
  Wide turn_numerator_ = 1, turn_denominator_ = 1;  // fine ticks of a turn
  double turn_ticks_ = 1.0, wow_ = 0.0, gust_ = 0.0;
  Wide origin_ = 0;

  // Twice the next ACP's number; odd: one too many.
  std::uint64_t half_acp_ = 0, arp_turn_ = 0, heading_turn_ = 0;
  AzimuthFaults faults_;
  // The last stall; the ARP and the bow at its very azimuth were before it.
  std::optional<Ratio> stalled_at_;
  Tick stalled_from_ = 0, stalled_until_ = 0;
  Wide stall_fine_ = 0;
  Tick earliest_ = 0;  // of the next pulse
  Pulse next_;
};

}  // namespace skerry::server
