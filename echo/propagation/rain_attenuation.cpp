#include "echo/propagation/rain_attenuation.hpp"

#include <numbers>
#include <span>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

// a exp(-((log10 f - b) / c)^2)
struct Bump {
  double a, b, c;
};
// The sum of bumps and a line m log10 f + c in log10 of the frequency in GHz.
struct RainFit {
  std::span<const Bump> bumps;
  double slope, offset;
};

constexpr Bump kKh[] = {{-5.33980, -0.10008, 1.13098},
                        {-0.35351, 1.26970, 0.45400},
                        {-0.23789, 0.86036, 0.15354},
                        {-0.94158, 0.64552, 0.16817}};
constexpr Bump kKv[] = {{-3.80595, 0.56934, 0.81061},
                        {-3.44965, -0.22911, 0.51059},
                        {-0.39902, 0.73042, 0.11899},
                        {0.50167, 1.07319, 0.27195}};
constexpr Bump kAlphaH[] = {{-0.14318, 1.82442, -0.55187},
                            {0.29591, 0.77564, 0.19822},
                            {0.32177, 0.63773, 0.13164},
                            {-5.37610, -0.96230, 1.47828},
                            {16.1721, -3.29980, 3.43990}};
constexpr Bump kAlphaV[] = {{-0.07771, 2.33840, -0.76284},
                            {0.56727, 0.95545, 0.54039},
                            {-0.20238, 1.14520, 0.26809},
                            {-48.2991, 0.791669, 0.116226},
                            {48.5833, 0.791459, 0.116479}};
constexpr RainFit kKhFit{kKh, -0.18961, 0.71147}, kKvFit{kKv, -0.16398, 0.63297};
constexpr RainFit kAlphaHFit{kAlphaH, 0.67849, -1.95537}, kAlphaVFit{kAlphaV, -0.053739, 0.83433};

double value_of(const RainFit& fit, double log10_ghz) {
  double sum = fit.slope * log10_ghz + fit.offset;
  for (const Bump& bump : fit.bumps) {
    const double x = (log10_ghz - bump.b) / bump.c;
    sum += bump.a * exact_exp2(-x * x * std::numbers::log2e);
  }
  return sum;
}

}  // namespace

RainLaw rain_law(double frequency_hz, Polarisation polarisation) {
  const double log10_ghz = 0.1 * decibels_from_ratio(frequency_hz * 1e-9);
  const bool level = polarisation == Polarisation::hh;
  return {ratio_from_decibels(10.0 * value_of(level ? kKhFit : kKvFit, log10_ghz)),
          value_of(level ? kAlphaHFit : kAlphaVFit, log10_ghz)};
}

double rain_db_per_km(const RainLaw& law, double rate_mm_h) {
  return rate_mm_h > 1e-30 ? law.k * exact_exp2(law.alpha * exact_log2(rate_mm_h)) : 0.0;
}

}  // namespace skerry::echo
