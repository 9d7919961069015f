// ExerciseClock: the exercise's time on one host, which is the leader's.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "server/fleet/host_clock.hpp"

namespace skerry::fleet {

// A grant says what time it was at the leader when it was sent; a host that hears it later lags by
// the way.  Of the last kSamples grants the fastest is believed, so the host's time lags the
// leader's by the shortest way of those: some 2 ms over etcd (README.md "Measured"), and never
// leads it, as long as the clocks' rates agree. Error: 3 s of grants at a rate that differs by a
// thousandth are 3 ms. Thread: one at a time.
class ExerciseClock {
 public:
  static constexpr std::size_t kSamples = 32;
  // Of a new leader so many are heard before the time goes back: the first may be late by an
  // election, and the leaders' times differ by milliseconds.
  static constexpr std::size_t kBelieved = 5;

  // Of the leader, or of an exercise that begins: `time` is now.
  void set(Duration time, HostTime now);
  // Of a host: a grant that said `sent` is heard now.
  void hear(Duration sent, HostTime now);
  // What was heard of a former leader counts no more.
  void forget() { samples_ = 0; }

  // Nothing: nobody has said what time it is.
  std::optional<Duration> at(HostTime now) const;
  // By how much the newest grant was later than the fastest, when it was heard.
  Duration delay() const { return delay_; }

 private:
  std::optional<HostTime> zero_;  // when the exercise's time was 0, by this host's clock
  std::array<HostTime, kSamples> heard_{};
  std::size_t samples_ = 0;
  std::size_t next_ = 0;
  Duration delay_{0};
};

}  // namespace skerry::fleet
