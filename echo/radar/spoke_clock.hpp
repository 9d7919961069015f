// SpokeClock: when the antenna points where.
#pragma once

#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// Azimuth and time are one count: spoke n of a turning antenna is at start + n * 60 s / (rpm *
// spokes), computed from n each time, so that nothing drifts.  Exact to 1 ns for rpm given in
// thousandths and 1e9 days of spokes.
//
// An antenna may turn at another rate from some spoke on.  Times never go back, and stay a function
// of the changes there were: each is exact to 1 ns from the last change.
class SpokeClock {
 public:
  // rpm in [1, 240].
  SpokeClock(double rpm, std::uint32_t spokes_per_turn, ScenarioTime start = ScenarioTime{})
      : milli_rpm_(thousandths(rpm)), spokes_(spokes_per_turn), start_(start) {}

  std::uint32_t spokes_per_turn() const { return spokes_; }
  double rpm() const { return static_cast<double>(milli_rpm_) / 1000.0; }

  // From that spoke on, which is when it was; spokes before it are then told as if the antenna had
  // always turned so.  No effect where the rate is the same to a thousandth.
  void change_rate(std::uint64_t spoke, double rpm) {
    if (thousandths(rpm) == milli_rpm_) return;
    start_ = time_of(spoke);
    first_ = spoke;
    milli_rpm_ = thousandths(rpm);
  }

  // The same antenna, counted in another number of azimuths.
  SpokeClock with_spokes(std::uint32_t spokes_per_turn) const {
    SpokeClock other = *this;
    const std::uint64_t turns = first_ / spokes_;
    other.start_ = time_of(turns * spokes_);
    other.first_ = turns * spokes_per_turn;
    other.spokes_ = spokes_per_turn;
    return other;
  }
  ScenarioTime time_of(std::uint64_t spoke) const {
    return spoke >= first_ ? start_ + duration_of(spoke - first_)
                           : start_ - duration_of(first_ - spoke);
  }
  double seconds_per_spoke() const {
    return 60'000.0 / (static_cast<double>(milli_rpm_) * spokes_);
  }
  friend bool operator==(const SpokeClock&, const SpokeClock&) = default;

 private:
  static std::uint64_t thousandths(double rpm) {
    return static_cast<std::uint64_t>(rpm * 1000.0 + 0.5);
  }
  Duration duration_of(std::uint64_t spokes) const {
    const auto numerator = static_cast<unsigned __int128>(spokes) * 60'000'000'000'000ull;
    const auto denominator = static_cast<unsigned __int128>(milli_rpm_) * spokes_;
    return Duration(static_cast<std::int64_t>(numerator / denominator));
  }

  std::uint64_t milli_rpm_;
  std::uint32_t spokes_;
  std::uint64_t first_ = 0;  // spoke at start_
  ScenarioTime start_;
};

}  // namespace skerry::echo
