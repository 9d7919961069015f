// When other radars send, exactly.
#pragma once

#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// Pulses without jitter at phase + n * period, in whole picoseconds of scenario time.  All that
// follows is integer arithmetic modulo the period, so nothing drifts however long a scenario runs.
// The period is 1 / PRF rounded to a picosecond.
// Held by PulseTrain.CountsOverThirtyDaysWithoutTheLossOfAPicosecond.
class PulseTrain {
 public:
  static constexpr std::int64_t kSecond = 1'000'000'000'000;  // picoseconds

  // `prf_hz` in [100, 20000].  The phase is a hash of the identity.
  PulseTrain(double prf_hz, std::uint64_t identity);

  std::int64_t period_ps() const { return period_ps_; }
  // From that time to the first pulse not before it, [0, period).
  std::int64_t wait_ps(ScenarioTime time) const;

 private:
  std::int64_t period_ps_;
  std::int64_t phase_ps_;
};

// Bearing of a beam that turns evenly, clockwise from the plane's north, 2^32 = one turn, given its
// bearing at scenario time 0.  Error: two units, at any time.  rpm in thousandths, in [1, 240].
// Held by BeamUnits.TurnExactlyForThirtyDays.
std::uint32_t beam_units(double bearing_deg, double rpm, ScenarioTime time);

}  // namespace skerry::echo
