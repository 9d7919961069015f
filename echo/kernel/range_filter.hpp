// The pulse and the receiver's filter along range, for mean power.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skerry::echo {

// power[i] becomes the sum over k of taps[k] * (power[j - k t] + ... + power[j - k t - t + 1]), t
// being tap_cells and j = i + lead: a kernel of taps.size() * t cells that is constant over t of
// them and begins `lead` cells before what it spreads.  Beyond the ends is nothing.  Sums of
// positive terms only, so a weak echo beside one 100 dB stronger keeps its value.
// Error: 1e-6 relative times the taps' number.  `scratch` is resized as needed and may be reused.
void filter_range(std::span<float> power, std::span<const float> taps, std::uint32_t tap_cells,
                  std::uint32_t lead, std::vector<float>& scratch);

// Twin: the direct sum in double.
void filter_range_reference(std::span<const float> power, std::span<const float> taps,
                            std::uint32_t tap_cells, std::uint32_t lead, std::span<double> out);

}  // namespace skerry::echo
