#include "server/fleet/exercise_clock.hpp"

#include <algorithm>

namespace skerry::fleet {

void ExerciseClock::set(Duration time, HostTime now) {
  zero_ = now - time;
  samples_ = 0;
}

void ExerciseClock::hear(Duration sent, HostTime now) {
  const HostTime zero = now - sent;
  if (samples_ == 0) next_ = 0;
  heard_[next_] = zero;
  next_ = (next_ + 1) % kSamples;
  samples_ = std::min(samples_ + 1, kSamples);
  const HostTime fastest =
      *std::min_element(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(samples_));
  if (!zero_ || fastest < *zero_ || samples_ >= kBelieved) zero_ = fastest;
  delay_ = zero - *zero_;
}

std::optional<Duration> ExerciseClock::at(HostTime now) const {
  if (!zero_) return std::nullopt;
  return now - *zero_;
}

}  // namespace skerry::fleet
