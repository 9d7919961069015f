// Time.  Nothing below server/app asks a clock: time is always passed in.
#pragma once

#include <chrono>
#include <cstdint>

namespace skerry {

using Duration = std::chrono::nanoseconds;

// Time since the scenario began: the clock of everything simulated.
struct ScenarioClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  using time_point = std::chrono::time_point<ScenarioClock>;
  static constexpr bool is_steady = true;
};
using ScenarioTime = ScenarioClock::time_point;

// UTC stands only in headers sent to others.
using UtcTime = std::chrono::time_point<std::chrono::system_clock, Duration>;

constexpr double in_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }
constexpr Duration seconds_as_duration(double s) {
  return Duration(static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}

}  // namespace skerry
