// Ticks of a board's sample clock, and pulses that come evenly in them.
#pragma once

#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// A tick of the sample clock, counted from scenario time 0: tick k begins at k / clock seconds.
using Tick = std::uint64_t;
// Wide enough for 10,000 years of ticks times any rate.
using Wide = __int128;

// Ticks and 2^-kFineBits of them, for times between ticks.
inline constexpr int kFineBits = 16;
constexpr Wide fine_of(Tick tick) { return static_cast<Wide>(tick) << kFineBits; }
// The nearest tick, the later of two; 0 for times before it.
constexpr Tick nearest_tick(Wide fine) {
  const Wide tick = (fine + (Wide{1} << (kFineBits - 1))) >> kFineBits;
  return tick < 0 ? 0 : static_cast<Tick>(tick);
}

// floor and ceiling of a / b.  Requires b > 0.
constexpr Wide floor_quotient(Wide a, Wide b) { return a / b - (a % b < 0 ? 1 : 0); }
constexpr Wide ceil_quotient(Wide a, Wide b) { return a / b + (a % b > 0 ? 1 : 0); }

// The tick that a time lies in: exact.
constexpr Tick tick_at(ScenarioTime time, std::uint32_t clock_hz) {
  const Wide ns = time.time_since_epoch().count();
  return ns <= 0 ? 0 : static_cast<Tick>(ns * clock_hz / 1'000'000'000);
}
// The beginning of a tick, to the ns before it.
constexpr ScenarioTime time_of(Tick tick, std::uint32_t clock_hz) {
  const Wide ns = static_cast<Wide>(tick) * 1'000'000'000 / clock_hz;
  return ScenarioTime(Duration(static_cast<std::int64_t>(ns)));
}
// The first ns that lies in a tick.
constexpr ScenarioTime first_time_in(Tick tick, std::uint32_t clock_hz) {
  const Wide ns = ceil_quotient(static_cast<Wide>(tick) * 1'000'000'000, clock_hz);
  return ScenarioTime(Duration(static_cast<std::int64_t>(ns)));
}

// Pulse n comes n * numerator / denominator ticks after the origin, at the nearest tick: a rational
// computed from n each time, so that after any number of pulses the error is still at most half a
// tick and nothing drifts.  Source: BOARD.md "Sources".  Held by TickClock.* for 30 days.
class TickSeries {
 public:
  TickSeries() = default;
  // origin: in fine ticks.  Requires 0 < numerator < 2^60, 0 < denominator < 2^40.
  TickSeries(Wide origin, std::uint64_t numerator, std::uint64_t denominator)
      : origin_(origin),
        numerator_(static_cast<Wide>(numerator) << kFineBits),
        denominator_(denominator) {}

  Tick at(std::uint64_t n) const {
    return nearest_tick(origin_ + static_cast<Wide>(n) * numerator_ / denominator_);
  }
  // The first pulse whose tick is not before that one.
  std::uint64_t first_from(Tick tick) const {
    const Wide fine = fine_of(tick) - (Wide{1} << (kFineBits - 1)) - origin_;
    return fine <= 0 ? 0
                     : static_cast<std::uint64_t>(ceil_quotient(fine * denominator_, numerator_));
  }
  // Whole ticks of a period.
  Tick period() const { return static_cast<Tick>((numerator_ / denominator_) >> kFineBits); }

 private:
  Wide origin_ = 0, numerator_ = Wide{1} << kFineBits, denominator_ = 1;
};

}  // namespace skerry::server
