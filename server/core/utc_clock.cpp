#include "server/core/utc_clock.hpp"

namespace skerry::server {

ClockReading read_clocks() {
  using Steady = std::chrono::steady_clock;
  ClockReading best{};
  auto least = Steady::duration::max();
  for (int i = 0; i < 3; ++i) {
    const Steady::time_point before = Steady::now();
    const auto utc = std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
    const Steady::duration took = Steady::now() - before;
    if (took >= least) continue;
    least = took;
    best = {before + took / 2, utc};
  }
  return best;
}

std::optional<ClockFollower::Step> ClockFollower::look(const ClockReading& now) {
  const ScenarioTime time(now.steady - zero_);
  const UtcTime told = clock_.at(time);
  const Duration off = now.utc - told;
  const Duration size = std::chrono::abs(off);
  if (size >= kStep) {
    clock_ = {time, now.utc, 0};
    return Step{told, now.utc};
  }
  std::int32_t slew = off > Duration::zero() ? kSlewPpm : -kSlewPpm;
  // What is begun goes on to the end.
  const bool goes_on = clock_.slew_ppm == slew && size > kIgnored / 2;
  if (size <= kIgnored && !goes_on) slew = 0;
  if (slew != clock_.slew_ppm) clock_ = {time, told, slew};
  return std::nullopt;
}

}  // namespace skerry::server
