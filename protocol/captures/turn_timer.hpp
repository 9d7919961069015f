// TurnTimer: how fast an antenna turns, by the spokes that come.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/quantity/time.hpp"

namespace skerry::captures {

// How long a turn takes: the middle one of many measurements, each of a sixteenth of a turn or more
// without a pause.
class TurnTimer {
 public:
  void take(std::uint32_t index, std::uint32_t spokes, UtcTime time) {
    const std::uint32_t steps = spokes == spokes_ ? (index + spokes - index_) % spokes : spokes;
    const Duration passed = time - time_;
    index_ = index;
    spokes_ = spokes;
    time_ = time;
    if (steps >= spokes / 4 || passed < Duration{} || passed > kPause) {
      steps_ = 0;
      begin_ = time;
      return;
    }
    steps_ += steps;
    // Radars send in bursts: only a spoke that comes after a while ends a measurement.
    if (steps_ < spokes / 16 || passed < kWhile) return;
    const double turn_s = in_seconds(time - begin_) * spokes / steps_;
    if (turn_s >= kShortest_s && turn_s <= kLongest_s && turns_s_.size() < kMost) {
      turns_s_.push_back(turn_s);
    }
    steps_ = 0;
    begin_ = time;
  }
  // 0: not known.
  Duration turn() const {
    if (turns_s_.empty()) return {};
    std::vector<double> sorted = turns_s_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return seconds_as_duration(*middle);
  }

 private:
  static constexpr Duration kPause = std::chrono::milliseconds(500);
  static constexpr Duration kWhile = std::chrono::milliseconds(1);
  static constexpr double kShortest_s = 0.2, kLongest_s = 120.0;
  static constexpr std::size_t kMost = 10'000;

  std::uint32_t index_ = 0, spokes_ = 0, steps_ = 0;
  UtcTime time_{}, begin_{};
  std::vector<double> turns_s_;
};

}  // namespace skerry::captures
