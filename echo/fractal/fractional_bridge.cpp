#include "echo/fractal/fractional_bridge.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

// 2^y - 1 without cancellation for small y.
double exp2_less_1(double y) {
  if (std::fabs(y) > 0.25) return exact_exp2(y) - 1.0;
  const double x = y * std::numbers::ln2;
  double sum = 1.0;
  for (int n = 14; n >= 2; --n) sum = 1.0 + sum * x / n;
  return x * sum;
}

}  // namespace

FractionalBridge::FractionalBridge(double hurst)
    : hurst_(hurst), scale_(4.0 / exp2_less_1(2.0 * (1.0 - hurst))) {}

// lag^2H - lag^2 = lag^2 (lag^(-2(1-H)) - 1), over its like at the middle: 2^-2H - 1/4.
double FractionalBridge::increment(double lag) const {
  if (lag == 0.0) return 0.0;
  return scale_ * lag * lag * exp2_less_1(-2.0 * (1.0 - hurst_) * exact_log2(lag));
}

double FractionalBridge::covariance(double s, double t) const {
  const double at_s[3] = {s, 0.0, 1.0}, at_t[3] = {t, 0.0, 1.0};
  const double weight_s[3] = {1.0, s - 1.0, -s}, weight_t[3] = {1.0, t - 1.0, -t};
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      sum += weight_s[i] * weight_t[j] * increment(std::fabs(at_s[i] - at_t[j]));
    }
  }
  return -0.5 * sum;
}

// The terms of covariance(t, t) that do not cancel.
double FractionalBridge::deviation(double t) const {
  return std::sqrt((1.0 - t) * increment(t) + t * increment(1.0 - t));
}

BridgeProfile::BridgeProfile(const FractionalBridge& bridge) {
  deviation_[0] = 0.0;
  double t = 0.5;
  for (std::size_t k = 1; k < deviation_.size(); ++k, t *= 0.5) deviation_[k] = bridge.deviation(t);
}

double BridgeProfile::reciprocal(double t) const {
  const double near = std::min(t, 1.0 - t);
  const auto bits = std::bit_cast<std::uint64_t>(near);
  const auto octave =
      static_cast<std::size_t>(1023 - (bits >> 52));  // near in [2^-octave, 2^(1-octave))
  const double mantissa =
      std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFull) | (std::uint64_t{1023} << 52));
  const double low = deviation_[octave], high = deviation_[octave - 1];
  return 1.0 / (low + (high - low) * (mantissa - 1.0));
}

}  // namespace skerry::echo
