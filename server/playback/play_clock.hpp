// PlayClock: which moment of a recording is due when.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// The recording's time runs `rate` times as fast as a steady clock.  By absolute deadlines from one
// anchor, so that nothing adds up; exact to a microsecond over a day.
class PlayClock {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  // From now on `moment` is due at `steady`.  Requires rate > 0.
  void set(UtcTime moment, SteadyTime steady, double rate) {
    moment_ = moment;
    steady_ = steady;
    rate_ = rate;
  }
  SteadyTime due(UtcTime moment) const { return steady_ + scaled(moment - moment_, 1.0 / rate_); }
  UtcTime at(SteadyTime steady) const { return moment_ + scaled(steady - steady_, rate_); }
  double rate() const { return rate_; }

 private:
  // A file may say any time: what lies further off than this is as far as makes no difference.
  // That much after recording::kLatestTime can still be told.
  static constexpr double kFarthest = 1e18;  // ns, 31 years
  static Duration scaled(Duration time, double factor) {
    const double ns = static_cast<double>(time.count()) * factor;
    return Duration(static_cast<std::int64_t>(std::clamp(ns, -kFarthest, kFarthest)));
  }

  UtcTime moment_{};
  SteadyTime steady_{};
  double rate_ = 1.0;
};

}  // namespace skerry::server
