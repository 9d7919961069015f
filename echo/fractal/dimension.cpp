#include "echo/fractal/dimension.hpp"

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

}  // namespace

double koch_dimension(double apex_factor) {
  double low = 1.0, high = 2.0;
  for (int step = 0; step < 30; ++step) {
    const double d = 0.5 * (low + high);
    (mean_length_sum(apex_factor, d) > 1.0 ? low : high) = d;
  }
  return 0.5 * (low + high);
}

double apex_factor_for_dimension(double dimension) {
  double low = 0.0, high = kMaxApexFactor;
  for (int step = 0; step < 30; ++step) {
    const double f = 0.5 * (low + high);
    (mean_length_sum(f, dimension) < 1.0 ? low : high) = f;
  }
  return 0.5 * (low + high);
}

}  // namespace skerry::echo
