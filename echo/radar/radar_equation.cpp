#include "echo/radar/radar_equation.hpp"

#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {

double received_watts_of_unit_target(const RadarSet& set) {
  const double gain = ratio_from_decibels(set.antenna_gain_db);
  const double lambda = kLightSpeed / set.frequency_hz;
  const double four_pi = 4.0 * std::numbers::pi;
  return set.peak_power_w * gain * gain * lambda * lambda /
         (four_pi * four_pi * four_pi * ratio_from_decibels(set.losses_db));
}

double noise_watts(const RadarSet& set, const Pulse& pulse) {
  return kBoltzmann * kNoiseTemperature * pulse.bandwidth_hz *
         ratio_from_decibels(set.noise_figure_db);
}

double unit_signal_to_noise(const RadarSet& set, const Pulse& pulse) {
  const double level = received_watts_of_unit_target(set) / noise_watts(set, pulse);
  return pulse.compression_db == 0.0 ? level : level * ratio_from_decibels(pulse.compression_db);
}

double hidden_height(double range_m, double antenna_height_m) {
  const double beyond = range_m - std::sqrt(2.0 * kEffectiveEarth * antenna_height_m);
  return beyond > 0.0 ? beyond * beyond / (2.0 * kEffectiveEarth) : 0.0;
}

double radar_horizon(double antenna_height_m, double target_height_m) {
  return std::sqrt(2.0 * kEffectiveEarth) *
         (std::sqrt(antenna_height_m) + std::sqrt(target_height_m));
}

}  // namespace skerry::echo
