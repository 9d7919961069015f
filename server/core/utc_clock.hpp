// UTC by the system's clock, which may be set at any time, for what runs by the steady one.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// UTC as a function of scenario time.
struct UtcClock {
  ScenarioTime from{};  // it was `utc` then
  UtcTime utc{};
  std::int32_t slew_ppm = 0;  // it goes so much faster, in millionths

  UtcTime at(ScenarioTime time) const {
    const Duration since = time - from;
    return utc + since + since / 1'000'000 * slew_ppm;
  }
  friend bool operator==(const UtcClock&, const UtcClock&) = default;
};

// Both clocks at one moment.
struct ClockReading {
  std::chrono::steady_clock::time_point steady;
  UtcTime utc;
};
using ReadClocks = std::function<ClockReading()>;
// Of this machine, to some microseconds; worse if the thread is interrupted three times.
ClockReading read_clocks();

// Follows the system's clock.  A difference of kStep or more is a step: UTC is at once what the
// system says.  A smaller one is made up for at kSlewPpm, so that no spoke is before the one before
// it; one below kIgnored is left alone, as it may come of the reading.
// Thread: one at a time.
class ClockFollower {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds(50);
  static constexpr Duration kIgnored = std::chrono::milliseconds(1);
  static constexpr std::int32_t kSlewPpm = 500;
  static constexpr std::chrono::milliseconds kLook{1000};  // between looks

  // `zero`: scenario time 0.
  explicit ClockFollower(ClockReading zero) : zero_(zero.steady), clock_{{}, zero.utc, 0} {}

  struct Step {
    UtcTime before, after;  // of one moment
    Duration by() const { return after - before; }
  };
  // Every kLook.  clock() may be another afterwards; a step is told.
  std::optional<Step> look(const ClockReading& now);
  const UtcClock& clock() const { return clock_; }

 private:
  std::chrono::steady_clock::time_point zero_;
  UtcClock clock_;
};

}  // namespace skerry::server
