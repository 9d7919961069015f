#include "server/plotter/motion/straight_filter.hpp"

#include <algorithm>

namespace skerry::server {

void StraightFilter::start(const MotionState& state) {
  state_ = state;
  state_.mean(4) = 0.0;
  state_.covariance.row(4).setZero();
  state_.covariance.col(4).setZero();
  seconds_ = doubt_ = 0.0;
}

void StraightFilter::predict(double seconds) {
  server::predict(state_, rule_.model, seconds);
  seconds_ += std::max(seconds, 0.0);
}

bool StraightFilter::correct(const MeasuredPlace& measured, double other_log2_density) {
  const Innovation found = innovation(state_, measured);
  server::correct(state_, measured, found);
  const double better =
      std::clamp(other_log2_density - found.log2_density, -rule_.most_bits, rule_.most_bits);
  doubt_ = std::max(doubt_ + better, 0.0);
  return doubt_ >= rule_.told_bits;
}

}  // namespace skerry::server
