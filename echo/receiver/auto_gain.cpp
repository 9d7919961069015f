#include "echo/receiver/auto_gain.hpp"

#include <algorithm>

namespace skerry::echo {

void AutoGain::add(double level_db) {
  const double place = std::clamp((level_db - kLowestDb) / kStepDb, 0.0, kClasses - 1.0);
  ++counts_[static_cast<std::size_t>(place)];
  ++bins_;
}

void AutoGain::finish_turn() {
  if (bins_ > 0) {
    std::uint64_t below = 0;
    std::size_t at = 0;
    while (at + 1 < kClasses && 2 * (below + counts_[at]) < bins_) below += counts_[at++];
    const double now = kLowestDb + kStepDb * (static_cast<double>(at) + 0.5);
    median_db_ = median_db_ ? 0.5 * (*median_db_ + now) : now;
  }
  drop_turn();
}

void AutoGain::drop_turn() {
  counts_.fill(0);
  bins_ = 0;
}

double AutoGain::threshold_db() const {
  return std::clamp(median_db_.value_or(0.0) + kOverMedianDb, kLeastDb, kMostDb);
}

}  // namespace skerry::echo
