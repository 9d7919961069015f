#include "echo/fractal/weierstrass_series.hpp"

#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kPhaseHasNoMeaning = 0x1p53;

SinCos sin_cos_radians(double x) {
  const double turns = x * (0.5 * std::numbers::inv_pi);
  return sin_cos_degrees((turns - std::floor(turns)) * 360.0);
}

// gamma^n; inf and 0 where it leaves the doubles.  Error: 2 log2|n| roundings.
double whole_power(double gamma, int n) {
  double power = 1.0, square = gamma;
  for (unsigned k = static_cast<unsigned>(n < 0 ? -n : n); k > 0; k >>= 1) {
    if (k & 1u) power *= square;
    square *= square;
  }
  return n < 0 ? 1.0 / power : power;
}

double term(const WeierstrassSeries& s, int n, double amplitude, double x) {
  const SinCos wave = sin_cos_radians(x);
  if (s.phases == SeriesPhases::alternating)
    return (n & 1) ? -amplitude * wave.sin : amplitude * wave.sin;
  // 1 - cos x as 2 sin^2(x/2): the low terms are many and small.
  const double half = sin_cos_radians(0.5 * x).sin;
  const double one_less_cosine = 2.0 * half * half;
  if (s.phases == SeriesPhases::cosine) return amplitude * one_less_cosine;
  const SinCos phase = sin_cos_units(random_phase(s.seed, n));
  return amplitude * (phase.cos * one_less_cosine + phase.sin * wave.sin);
}

}  // namespace

std::uint32_t random_phase(std::uint64_t seed, int n) {
  const std::int64_t eight = n >> 3;
  const std::uint64_t phases = mixed(mixed(seed) ^ static_cast<std::uint64_t>(eight));
  return static_cast<std::uint32_t>((phases >> (8 * (n & 7))) & 0xFFu) << 24;
}

double weierstrass(const WeierstrassSeries& s, double t) {
  const double log2_gamma = exact_log2(s.gamma), h = 2.0 - s.dimension;
  double sum = 0.0;
  for (int n = s.first; n <= s.last; ++n) {
    const double octaves = n * log2_gamma;
    if (octaves < -500.0) continue;  // below 2^-500 t^2
    const double x = whole_power(s.gamma, n) * t;
    if (!(std::fabs(x) < kPhaseHasNoMeaning)) break;
    sum += term(s, n, exact_exp2(-h * octaves), x);
  }
  return sum;
}

double high_tail_bound(double gamma, double dimension, int last) {
  const double h = (2.0 - dimension) * exact_log2(gamma);
  return 2.0 * exact_exp2(-h * (last + 1)) / (1.0 - exact_exp2(-h));
}

double low_tail_bound(double gamma, double dimension, int first, double t) {
  const double d = dimension * exact_log2(gamma);
  return 0.5 * t * t * exact_exp2(d * (first - 1)) / (1.0 - exact_exp2(-d));
}

}  // namespace skerry::echo
