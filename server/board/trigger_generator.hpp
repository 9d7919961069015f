// TriggerGenerator: when the transmitter fires.
#pragma once

#include "server/board/tick_clock.hpp"

namespace skerry::server {

struct TriggerSettings {
  std::uint32_t clock_hz = 20'000'000;
  std::uint32_t prf_millihertz = 3'000'000;
  // Parts per million of the period.  Their sum is below 500,000, so that triggers never change
  // places.
  std::uint32_t jitter_ppm = 0, stagger_ppm = 0;
  std::uint64_t seed = 0;  // of the jitter
  friend bool operator==(const TriggerSettings&, const TriggerSettings&) = default;
};

// Trigger n of a TickSeries, displaced by a pure function of its place: by up to jitter to either
// side, uniformly to a tick, and by stagger, later and earlier by turns.  With either all triggers
// come later by the most that one could come early, so that none lies before its series' place.
// The shortest time between two is board::shortest_trigger_period.
// Settings that change begin a new series, one period after the last trigger.
class TriggerGenerator {
 public:
  // The first trigger comes at tick 0.
  explicit TriggerGenerator(const TriggerSettings& settings) { lay(settings, 0); }

  // From `now` on; no trigger before it is left to come.
  void set(const TriggerSettings& settings, Tick now);

  Tick next() const { return next_; }
  void pop() {
    last_ = next_;
    fired_ = true;
    next_ = tick_of(++index_);
  }
  // Leaves out those before `tick`; gives how many.  The cost is the same for any number.
  std::uint64_t skip_to(Tick tick);
  // How many come in [from, to), nothing taken.
  std::uint64_t count(Tick from, Tick to) const;

 private:
  void lay(const TriggerSettings& settings, Tick origin);
  Tick tick_of(std::uint64_t n) const;
  std::uint64_t first_from(Tick tick) const;

  TriggerSettings settings_;
  TickSeries series_;
  std::uint64_t jitter_ = 0, stagger_ = 0;  // ticks
  std::uint64_t index_ = 0;
  Tick next_ = 0, last_ = 0;
  bool fired_ = false;  // last_ is the tick of a trigger
};

}  // namespace skerry::server
