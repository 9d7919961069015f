// The hot loops of a digitised sweep: where between rows and cells its samples lie, the converter
// behind a logarithmic or a linear detector, and decimation of its codes.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::echo {

// out[i] = before[i] + share * (after[i] - before[i]).  share in [0, 1].  No overlap of `out`.
// Never negative where its inputs are not.  Error: 2e-7 of the larger input.
void blend_rows(std::span<const float> before, std::span<const float> after, float share,
                std::span<float> out) noexcept;

// out[i]: on the straight line between the values of `cells` about place first + i * step.
// Requires first, step >= 0 and (n - 1) * step + first + 1e-6 n step < cells.size() - 1.
// Error: 2e-7 of the larger neighbour, at a place 1.2e-7 (first + i step) off.
void sample_row(std::span<const float> cells, float first, float step,
                std::span<float> out) noexcept;

// An analogue-digital converter: codes 0 .. top, top = 2^bits - 1; flip: 0, or top for a converter
// that counts downwards.
struct ConverterScale {
  float top = 4095.0f;
  std::uint32_t flip = 0;
};

// codes[i] = flip ^ clamp(per_octave * log2(power[i]) + offset[i], 0, top), rounded down.
// power: echo and noise together, >= 0, finite.
// Error: kFastLog2Error * per_octave + 2e-7 (per_octave |log2(power)| + |offset|) before rounding.
void convert_log(std::span<const float> power, float per_octave, std::span<const float> offset,
                 ConverterScale scale, std::span<std::uint16_t> codes) noexcept;

// codes[i] = flip ^ clamp(factor[i] * sqrt(power[i]) + offset, 0, top), rounded down.
// Error: 2e-7 (factor sqrt(power) + |offset|) before rounding.
void convert_linear(std::span<const float> power, std::span<const float> factor, float offset,
                    ConverterScale scale, std::span<std::uint16_t> codes) noexcept;

// Takes from every `group` codes the largest, the mean rounded to the nearest (halves upwards), or
// the sum (65535 where it is larger).  Exact. Requires group in 1 .. 65536, codes.size() == group *
// out.size(), no overlap.
void decimate_by_peak(std::span<const std::uint16_t> codes, std::uint32_t group,
                      std::span<std::uint16_t> out) noexcept;
void decimate_by_mean(std::span<const std::uint16_t> codes, std::uint32_t group,
                      std::span<std::uint16_t> out) noexcept;
void decimate_by_sum(std::span<const std::uint16_t> codes, std::uint32_t group,
                     std::span<std::uint16_t> out) noexcept;

// Twins in double with libm, before rounding, clamping and flip.
double sample_row_reference(std::span<const float> cells, double place);
double convert_log_reference(double power, double per_octave, double offset);
double convert_linear_reference(double power, double factor, double offset);

}  // namespace skerry::echo
