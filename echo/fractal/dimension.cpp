#include "echo/fractal/dimension.hpp"

#include <numbers>

#include "echo/fractal/koch_edge.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr int kSamples = 1024;

// Mean over fixed seeds of the sum of (piece length / edge length)^dimension.
double mean_length_sum(double apex_factor, double dimension) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const KochJoints k = koch_joints(mixed(0xD13E, i), {kMaxHalfAngleTan, apex_factor});
    const auto power = [&](double along, double across) {
      return exact_exp2(0.5 * dimension * exact_log2(along * along + across * across));
    };
    sum += power(k.first, 0.0) + power(k.apex_along - k.first, k.apex_height) +
           power(k.last - k.apex_along, k.apex_height) + power(1.0 - k.last, 0.0);
  }
  return sum / kSamples;
}

double power(double x, double exponent) { return exact_exp2(exponent * exact_log2(x)); }

// E[2 (1/4 + r^2)^(D/2)] for a Gaussian r of standard deviation `spread`, by the trapezoidal rule,
// which converges faster than any power of the step here.
double mean_middle_sum(double spread, double dimension) {
  double sum = 0.0, weights = 0.0;
  for (int i = -32; i <= 32; ++i) {
    const double z = 0.25 * i;
    const double weight = exact_exp2(-0.5 * std::numbers::log2e * z * z);
    sum += weight * 2.0 * power(0.25 + spread * spread * z * z, 0.5 * dimension);
    weights += weight;
  }
  return sum / weights;
}

// The place where `rising` passes 1 between low and high, or the nearer end; by false position,
// Illinois rule (about 8 evaluations for what 40 halvings give).  Error: 1e-12 of the bracket.
template <typename Function>
double solve_for_1(double low, double high, const Function& rising) {
  double below = rising(low) - 1.0, above = rising(high) - 1.0;
  if (below >= 0.0) return low;
  if (above <= 0.0) return high;
  const double enough = 1e-12 * (high - low);
  int kept = 0;  // which end stood still: -1 low, +1 high
  for (int step = 0; step < 60 && high - low > enough; ++step) {
    const double x = low + (high - low) * (-below / (above - below));
    const double y = rising(x) - 1.0;
    if (y == 0.0) return x;
    if (y < 0.0) {
      if (x - low <= enough && kept == 1) return x;
      low = x;
      below = y;
      if (kept == 1) above *= 0.5;
      kept = 1;
    } else {
      if (high - x <= enough && kept == -1) return x;
      high = x;
      above = y;
      if (kept == -1) below *= 0.5;
      kept = -1;
    }
  }
  return 0.5 * (low + high);
}

double regular_length_sum(double apex_factor, double dimension) {
  const KochJoints k = regular_koch_joints(true, {kMaxHalfAngleTan, apex_factor});
  const double across = k.apex_along - k.first;
  return 2.0 * power(k.first, dimension) +
         2.0 * power(across * across + k.apex_height * k.apex_height, 0.5 * dimension);
}

}  // namespace

double regular_koch_dimension(double apex_factor) {
  return solve_for_1(1.0, 2.0, [&](double d) { return 2.0 - regular_length_sum(apex_factor, d); });
}

double regular_apex_factor_for_dimension(double dimension) {
  return solve_for_1(0.0, kMaxRegularApexFactor,
                     [&](double f) { return regular_length_sum(f, dimension); });
}

double self_similar_spread(double dimension) {
  if (dimension <= 1.0) return 0.0;
  return solve_for_1(0.0, 1.0, [&](double s) { return mean_middle_sum(s, dimension); });
}

double koch_dimension(double apex_factor) {
  return solve_for_1(1.0, 2.0, [&](double d) { return 2.0 - mean_length_sum(apex_factor, d); });
}

double apex_factor_for_dimension(double dimension) {
  return solve_for_1(0.0, kMaxApexFactor, [&](double f) { return mean_length_sum(f, dimension); });
}

}  // namespace skerry::echo
