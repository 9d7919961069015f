#include "server/plotter/motion/imm_filter.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {
namespace {

// The state whose mean and covariance are those of the mixture.
template <std::size_t N>
MotionState mixture(const std::array<MotionState, N>& states,
                    const std::array<double, N>& weights) {
  MotionState mixed;
  mixed.mean.setZero();
  mixed.covariance.setZero();
  for (std::size_t i = 0; i < N; ++i) mixed.mean += weights[i] * states[i].mean;
  for (std::size_t i = 0; i < N; ++i) {
    const MotionVector off = states[i].mean - mixed.mean;
    mixed.covariance += weights[i] * (states[i].covariance + off * off.transpose());
  }
  return mixed;
}

}  // namespace

void ImmFilter::start(const MotionState& state) {
  states_.fill(state);
  for (std::size_t i = 0; i < kModels; ++i) {
    if (rule_.models[i].turns) continue;
    states_[i].mean(4) = 0.0;
  }
  shares_ = rule_.shares;
  join();
}

void ImmFilter::mix(double seconds) {
  // Share of model i that has become model j.
  std::array<std::array<double, kModels>, kModels> moved{};
  std::array<double, kModels> next{};
  for (std::size_t i = 0; i < kModels; ++i) {
    const double leaves = std::min(seconds / rule_.lasts_s[i], 0.5);
    for (std::size_t j = 0; j < kModels; ++j) {
      moved[i][j] = shares_[i] * (i == j ? 1.0 - leaves : leaves / (kModels - 1));
      next[j] += moved[i][j];
    }
  }
  std::array<MotionState, kModels> mixed;
  for (std::size_t j = 0; j < kModels; ++j) {
    std::array<double, kModels> weights{};
    for (std::size_t i = 0; i < kModels; ++i) weights[i] = moved[i][j] / next[j];
    mixed[j] = mixture(states_, weights);
  }
  states_ = mixed;
  shares_ = next;
}

void ImmFilter::predict(double seconds) {
  if (!(seconds > 0.0)) return;
  mix(seconds);
  for (std::size_t i = 0; i < kModels; ++i) server::predict(states_[i], rule_.models[i], seconds);
  join();
}

double ImmFilter::correct(const MeasuredPlace& measured) {
  std::array<double, kModels> logs{};
  double greatest = -1e300;
  for (std::size_t i = 0; i < kModels; ++i) {
    const Innovation found = innovation(states_[i], measured);
    server::correct(states_[i], measured, found);
    logs[i] = found.log2_density + echo::exact_log2(shares_[i]);
    greatest = std::max(greatest, logs[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kModels; ++i) {
    // No model dies out: it would not come back in time.
    shares_[i] = std::max(echo::exact_exp2(std::max(logs[i] - greatest, -60.0)), 1e-6);
    sum += shares_[i];
  }
  for (double& share : shares_) share /= sum;
  join();
  return greatest + echo::exact_log2(sum);
}

void ImmFilter::join() { whole_ = mixture(states_, shares_); }

}  // namespace skerry::server
