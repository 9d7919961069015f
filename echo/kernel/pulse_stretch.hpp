// The pulse's length in range: each scatterer fills c*tau/2 behind it.
#pragma once

#include <span>
#include <vector>

namespace skerry::echo {

// power[i] becomes the sum of power[i-k] * w_k over the pulse: whole cells weigh 1, the last one
// the fraction left, so that a pulse of `pulse_cells` (>= 1; less counts as 1) cells has that much
// total weight.  Sums of positive terms only (log2 passes, no running difference): a weak echo
// beside one 100 dB stronger keeps its value.  Error: 2e-6 relative.
// `scratch` is resized as needed and may be reused.  Requires power.size() <= 2^16.
void stretch_pulse(std::span<float> power, double pulse_cells, std::vector<float>& scratch);

// Twin: the direct sum in double.
void stretch_pulse_reference(std::span<const float> power, double pulse_cells,
                             std::span<double> out);

}  // namespace skerry::echo
