#include "echo/clutter/rain_returns.hpp"

#include <algorithm>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/rain_row.hpp"
#include "echo/radar/antenna_pattern.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

// Two-way width of a Gaussian beam, sqrt(pi / (8 ln 2)) of its -3 dB width (SOURCES.md "Sets").
constexpr double kVerticalWidth = 0.75270;
constexpr double kNearestRain = 1.0;  // m: nearer counts as this

}  // namespace

double rain_reflectivity(double frequency_hz, double rate_mm_h) {
  if (!(rate_mm_h > 0.0)) return 0.0;
  constexpr double kPi5 = 306.01968478528145;
  const double lambda = kLightSpeed / frequency_hz;
  const double z = 200.0 * exact_exp2(1.6 * exact_log2(rate_mm_h));
  return kPi5 * 0.93 * z * 1e-18 / (lambda * lambda * lambda * lambda);
}

double rain_level(const RadarModel& model, double clutter_width, double range_m) {
  const double range = std::max(range_m, kNearestRain);
  const double height =
      std::min(kVerticalWidth * model.set.vertical_beam_deg * kRadiansPerDegree * range, kRainTop);
  const double volume = range * clutter_width * height * 0.5 * kLightSpeed * model.pulse.length_s;
  return model.unit_snr * rain_reflectivity(model.set.frequency_hz, 1.0) * volume /
         (range * range * range * range);
}

void rain_echoes(std::span<const float> rate_mm_h, std::span<float> echoes) {
  rain_losses(rate_mm_h, 0.0f, 1.6f, echoes);
}

RainReturns::RainReturns(const RadarModel& model)
    : radar_(model.radar), spokes_per_turn_(model.geometry.spokes_per_turn) {
  // Within the rain's top the level goes as R^-2, beyond as R^-3: one value of each is enough.
  const double width = antenna_pattern_for(model.set)->clutter_width();
  const double near = rain_level(model, width, kNearestRain) * kNearestRain * kNearestRain;
  constexpr double kFar = 1e6;
  const double far = rain_level(model, width, kFar) * kFar * kFar * kFar;
  for (std::uint32_t i = 0; i < model.geometry.cells; ++i) {
    const double range = std::max((i + 0.5) * model.cell_m, kNearestRain);
    level_.push_back(
        static_cast<float>(std::min(near / (range * range), far / (range * range * range))));
  }
  constexpr double kSpread = 1.0;  // m/s, standard deviation of the drops' speeds along the beam
  const double lifetime =
      model.set.wavelength_m() * std::numbers::sqrt2 / (4.0 * std::numbers::pi * kSpread);
  const SpeckleLengths lengths = speckle_lengths(model, lifetime);
  speckle_ = speckle_for(lengths.spokes, lengths.cells);
}

void RainReturns::pass(std::uint64_t seed, const SpokeAim& aim, const RainKnots& rain,
                       std::span<float> power) const {
  const std::size_t end = std::min({rain.end, level_.size(), power.size()});
  if (rain.first >= end) return;
  const auto speckle =
      speckle_->row({mixed(seed, radar_, 0x4A1A), aim.scan, aim.index, spokes_per_turn_},
                    static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(rain.first));
  const std::size_t count = end - rain.first;
  pass_rain(rain.echoes, rain.transmission, rain.step, std::span(level_).subspan(rain.first, count),
            speckle.subspan(rain.first, count), power.subspan(rain.first, count));
  const float behind = rain.transmission.back();
  for (float& p : power.subspan(end)) p *= behind;
}

}  // namespace skerry::echo
