// Rain along a spoke: its effect at knots and between them.
#pragma once

#include <cstddef>
#include <span>

namespace skerry::echo {

// A cloud under a spoke, metres along it.
struct CloudChord {
  float middle_m = 0.0f;        // nearest to the cloud's middle
  float across_squared = 0.0f;  // the square of how near, m2
  float radius_squared = 1.0f;  // m2
  float rate_mm_h = 0.0f;       // in the middle
};

// rates[j] += the cloud's rate at first_m + j * step_m: all of it within half the radius, none from
// the radius on, a smoothstep of the squared distance between.
void add_cloud(const CloudChord& cloud, float first_m, float step_m,
               std::span<float> rates) noexcept;
double cloud_rate_reference(const CloudChord& cloud, double at_m);

// losses[j] = 2^(log2_k + alpha log2(rates[j] + 1e-6)).  Requires equal sizes, rates >= 0 and a
// result from 1e-37 to 1e37.  Error: 4e-4 relative for alpha <= 2.  Held by
// RainRow.LossIsThePowerLaw.
void rain_losses(std::span<const float> rates, float log2_k, float alpha,
                 std::span<float> losses) noexcept;

// Each number of octaves lost, 0 to 126, becomes the power left, 2^-octaves.
void power_left(std::span<float> octaves) noexcept;

// row[j * step + i] = the i-th of `step` even steps from knots[j] to knots[j + 1].  step: 1, 2, 4,
// 8 or 16; requires row.size() <= (knots.size() - 1) * step.
void spread_knots(std::span<const float> knots, std::size_t step, std::span<float> row) noexcept;

// power[i] = (power[i] + level[i] * e * speckle[i]) * t: rain echoes where the beam has lost as
// much as it has, and dims what lies in it.  e and t go from `step` to `step` cells through
// echoes[j] and left[j], as in spread_knots; level and speckle are as long as power.  Error: float
// roundings.
void pass_rain(std::span<const float> echoes, std::span<const float> left, std::size_t step,
               std::span<const float> level, std::span<const float> speckle,
               std::span<float> power) noexcept;

void fill_row(float value, std::span<float> row) noexcept;

}  // namespace skerry::echo
