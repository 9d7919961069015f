// SpokeClock: when the antenna points where.
#pragma once

#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// Azimuth and time are one count: spoke n of a turning antenna is at start + n * 60 s / (rpm *
// spokes), computed from n each time, so that nothing drifts.  Exact to 1 ns for rpm given in
// thousandths and 1e9 days of spokes.
class SpokeClock {
 public:
  // rpm in [1, 240].
  SpokeClock(double rpm, std::uint32_t spokes_per_turn, ScenarioTime start = ScenarioTime{})
      : milli_rpm_(static_cast<std::uint64_t>(rpm * 1000.0 + 0.5)),
        spokes_(spokes_per_turn),
        start_(start) {}

  std::uint32_t spokes_per_turn() const { return spokes_; }
  // The same antenna, counted in another number of azimuths.
  SpokeClock with_spokes(std::uint32_t spokes_per_turn) const {
    SpokeClock other = *this;
    other.spokes_ = spokes_per_turn;
    return other;
  }
  ScenarioTime time_of(std::uint64_t spoke) const {
    const auto numerator = static_cast<unsigned __int128>(spoke) * 60'000'000'000'000ull;
    const auto denominator = static_cast<unsigned __int128>(milli_rpm_) * spokes_;
    return start_ + Duration(static_cast<std::int64_t>(numerator / denominator));
  }
  double seconds_per_spoke() const {
    return 60'000.0 / (static_cast<double>(milli_rpm_) * spokes_);
  }

 private:
  std::uint64_t milli_rpm_;
  std::uint32_t spokes_;
  ScenarioTime start_;
};

}  // namespace skerry::echo
