#include "echo/clutter/swell_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/clutter/nrl_sea.hpp"
#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

constexpr double kTilt = 12.0;          // of the power, per unit of steepness
constexpr double kMostTilt = 2.0;       // octaves
constexpr double kDeepestShadow = 4.0;  // octaves

}  // namespace

SwellWave::SwellWave(const Swell& swell) {
  if (!(swell.height_m > 0.0)) return;
  period_s_ = std::max(swell.period_s, 1.0);
  length_m_ = kGravity * period_s_ * period_s_ / kRadiansPerTurn;
  steepness_ = std::numbers::pi * swell.height_m / length_m_;
  const SinCos from = sin_cos_degrees(swell.from_deg);
  east_ = -from.sin;
  north_ = -from.cos;
}

SwellWave::Modulation SwellWave::modulation(double grazing_rad, double towards) const {
  const double tilt = std::min(kMostTilt, std::numbers::log2e * kTilt * steepness_) * towards;
  const double hidden = std::clamp(1.0 - grazing_rad / steepness_, 0.0, 1.0);
  const double shadow = 0.5 * kDeepestShadow * hidden * std::fabs(towards);
  Modulation m;
  m.height = std::sqrt(tilt * tilt + shadow * shadow);
  m.lead = exact_atan2(tilt, shadow) / kRadiansPerTurn;
  const double natural = std::numbers::ln2 * m.height;
  const double mean = bessel_i0(natural);
  m.mean = exact_log2(mean);
  m.variance = bessel_i0(2.0 * natural) / (mean * mean) - 1.0;
  return m;
}

double SwellWave::phase_at(PlanePoint from, double seconds) const {
  const double turns =
      (from.east_m * east_ + from.north_m * north_) / length_m_ - seconds / period_s_;
  return turns - std::floor(turns);
}

}  // namespace skerry::echo
