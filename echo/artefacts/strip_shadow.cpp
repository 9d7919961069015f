#include "echo/artefacts/strip_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

// Fresnel widths beside the shadow over which it is followed, and over how many of the last of
// them it fades to nothing.
constexpr double kFollowed = 12.0, kFades = 4.0;
constexpr double kMostSteps = 8192.0;

// Past a half plane by z >= 0.
Voltage in_shadow(double z) {
  double f, g;
  if (z < 5.0) {
    f = (1.0 + 0.926 * z) / (2.0 + 1.792 * z + 3.104 * z * z);
    g = 1.0 / (2.0 + 4.142 * z + 3.492 * z * z + 6.670 * z * z * z);
  } else {
    const double pi_z = std::numbers::pi * z, square = std::numbers::pi * z * z;
    f = (1.0 - 3.0 / (square * square)) / pi_z;
    g = 1.0 / (pi_z * square);
  }
  const double turns = 0.25 * z * z;
  const SinCos phase = sin_cos_degrees(360.0 * (turns - std::floor(turns)));
  // 1/2 - C and 1/2 - S.
  const double c = g * phase.cos - f * phase.sin;
  const double s = f * phase.cos + g * phase.sin;
  return {0.5 * (c + s), 0.5 * (c - s)};
}

}  // namespace

Voltage past_half_plane(double v) {
  if (v >= 0.0) return in_shadow(v);
  const Voltage rest = in_shadow(-v);
  return {1.0 - rest.in_phase, -rest.quadrature};
}

double antenna_width_m(double beam_width_deg, double wavelength_m) {
  return 68.8 * wavelength_m / beam_width_deg;
}

StripShadow::StripShadow(const Obstruction& obstruction, double wavelength_m, double antenna_m) {
  const double half = 0.5 * obstruction.width_m;
  const double fresnel = std::sqrt(0.5 * wavelength_m * obstruction.distance_m);
  const double reach = half + 0.5 * antenna_m + kFollowed * fresnel;
  step_m_ = std::max(reach / kMostSteps, std::min(fresnel, std::max(antenna_m, fresnel)) / 16.0);

  // The field from the middle out to where the antenna's far end reaches.
  const auto taps = static_cast<std::size_t>(0.5 * antenna_m / step_m_);
  const auto count = static_cast<std::size_t>(reach / step_m_) + 1;
  std::vector<Voltage> field(count + taps);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double y = static_cast<double>(i) * step_m_;
    const Voltage right = past_half_plane((half - y) / fresnel);
    const Voltage left = past_half_plane((half + y) / fresnel);
    field[i] = {right.in_phase + left.in_phase, right.quadrature + left.quadrature};
  }
  std::vector<double> taper(taps + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k <= taps; ++k) {
    taper[k] =
        k == 0 ? 1.0 : sin_cos_degrees(180.0 * static_cast<double>(k) * step_m_ / antenna_m).cos;
    sum += k == 0 ? taper[k] : 2.0 * taper[k];
  }

  power_.resize(count);
  const double fade_from = reach - kFades * fresnel;
  for (std::size_t i = 0; i < count; ++i) {
    Voltage gathered;
    for (std::size_t k = 0; k <= taps; ++k) {
      const Voltage& far = field[i + k];
      gathered.in_phase += taper[k] * far.in_phase;
      gathered.quadrature += taper[k] * far.quadrature;
      if (k == 0) continue;
      const Voltage& near = field[i > k ? i - k : k - i];
      gathered.in_phase += taper[k] * near.in_phase;
      gathered.quadrature += taper[k] * near.quadrature;
    }
    const double power =
        (gathered.in_phase * gathered.in_phase + gathered.quadrature * gathered.quadrature) /
        (sum * sum);
    const double fade =
        std::clamp((static_cast<double>(i) * step_m_ - fade_from) / (kFades * fresnel), 0.0, 1.0);
    power_[i] = static_cast<float>(std::max(power, kLeastGain) * (1.0 - fade) + fade);
  }
}

double StripShadow::one_way(double lateral_m) const {
  const double at = std::fabs(lateral_m) / step_m_;
  if (!(at < static_cast<double>(power_.size() - 1))) return 1.0;
  const auto i = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(i);
  return (1.0 - t) * double{power_[i]} + t * double{power_[i + 1]};
}

}  // namespace skerry::echo
