#include "echo/radar/beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {

double cosine_taper_voltage(double angle_deg, double beam_width_deg) {
  const double mu = std::numbers::pi * 68.8 * sin_cos_degrees(angle_deg).sin / beam_width_deg;
  const double x = 2.0 * mu / std::numbers::pi;
  // Both numerator and denominator vanish at x = 1; the limit is pi/4.
  if (std::fabs(1.0 - x * x) < 1e-9) return std::numbers::pi / 4.0;
  return sin_cos_degrees(mu * (180.0 / std::numbers::pi)).cos / (1.0 - x * x);
}

Beam beam_over_rays(double beam_width_deg, std::uint32_t spokes_per_turn) {
  Beam beam;
  const double rays_wanted = Beam::kRaysPerBeam * 360.0 / beam_width_deg;
  beam.per_spoke =
      std::max(1u, static_cast<std::uint32_t>(std::ceil(rays_wanted / spokes_per_turn)));
  const double step = 360.0 / (double{1} * spokes_per_turn * beam.per_spoke);
  const double floor = ratio_from_decibels(kBeamFloorDb);
  std::vector<float> one_side;
  for (std::uint32_t k = 0;; ++k) {
    const double voltage = cosine_taper_voltage(k * step, beam_width_deg);
    const double two_way = voltage * voltage * voltage * voltage;
    if (voltage <= 0.0 || two_way < floor) break;
    one_side.push_back(static_cast<float>(two_way));
  }
  beam.half = static_cast<std::uint32_t>(one_side.size()) - 1;
  for (std::size_t k = one_side.size(); k-- > 1;) beam.weights.push_back(one_side[k]);
  beam.weights.insert(beam.weights.end(), one_side.begin(), one_side.end());
  return beam;
}

}  // namespace skerry::echo
