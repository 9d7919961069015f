// The beam pattern across azimuth: a weighted sum of rays.
#pragma once

#include <span>

namespace skerry::echo {

// One ray's returns and its weight in the sum.
struct WeightedRay {
  const float* power = nullptr;  // at least `count` cells
  float weight = 0.0f;
};

// sum[i] = rays[0].weight * rays[0].power[i] + rays[1]... , added in the order given, for
// i < sum.size().  A ray of zeros may be left out: adding zero changes no bit of a sum of
// non-negative terms.  Error: one float rounding per product and addition.
void sum_rays(std::span<const WeightedRay> rays, std::span<float> sum) noexcept;

// Twin in double.
void sum_rays_reference(std::span<const WeightedRay> rays, std::span<double> sum);

}  // namespace skerry::echo
