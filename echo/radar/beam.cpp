#include "echo/radar/beam.hpp"

#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {

double cosine_taper_voltage(double angle_deg, double beam_width_deg) {
  const double mu = std::numbers::pi * 68.8 * sin_cos_degrees(angle_deg).sin / beam_width_deg;
  const double x = 2.0 * mu / std::numbers::pi;
  // Both numerator and denominator vanish at x = 1; the limit is pi/4.
  if (std::fabs(1.0 - x * x) < 1e-9) return std::numbers::pi / 4.0;
  return sin_cos_degrees(mu * kDegreesPerRadian).cos / (1.0 - x * x);
}

std::vector<float> beam_weights(double beam_width_deg, std::uint32_t rays, double part,
                                std::uint32_t reach) {
  const double floor = ratio_from_decibels(kBeamFloorDb);
  std::vector<float> weights(2 * reach + 1, 0.0f);
  for (std::uint32_t k = 0; k < weights.size(); ++k) {
    const double off = (static_cast<double>(k) - static_cast<double>(reach) - part) * 360.0 / rays;
    if (std::fabs(off) > 1.25 * beam_width_deg) continue;  // beyond the main lobe
    const double voltage = cosine_taper_voltage(off, beam_width_deg);
    const double two_way = voltage * voltage * voltage * voltage;
    if (voltage > 0.0 && two_way >= floor) weights[k] = static_cast<float>(two_way);
  }
  return weights;
}

}  // namespace skerry::echo
