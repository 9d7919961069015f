// The receiver's hot loop: noise, log detector, gain and STC, quantiser.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::echo {

// Which noise a spoke gets: two halves of a hash of (seed, radar, scan, spoke).
struct NoiseKey {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};
NoiseKey noise_key(std::uint64_t seed, std::uint32_t radar, std::uint32_t scan,
                   std::uint32_t spoke);

// Square-law-detected receiver noise of one cell, unit mean, exponentially distributed (Rayleigh
// amplitude): -ln(u), u in (0, 1) with 24 bits.  Reference of what the kernels add.
double unit_noise_reference(NoiseKey key, std::uint32_t cell);

struct QuantiserScale {
  float per_octave = 1.0f;  // video steps per factor of two in power
  float top = 255.0f;       // largest video value
};

// video[i] = clamp(per_octave * log2(power[i] + noise_i) + offset[i], 0, top), rounded down.
// power: mean power over receiver noise, >= 0, finite; offset: gain and STC in video steps.
// Requires equal sizes, no overlap.  Error: kFastLog2Error * per_octave before rounding.
void detect_and_quantise(std::span<const float> power, std::span<const float> offset, NoiseKey key,
                         QuantiserScale scale, std::span<std::uint8_t> video) noexcept;

// The same without offset and quantiser, in octaves: log2(power[i] + noise_i).
void detect(std::span<const float> power, NoiseKey key, std::span<float> octaves) noexcept;

// video[i] = clamp(per_octave * octaves[i] + offset[i], 0, top), rounded down.
void quantise(std::span<const float> octaves, std::span<const float> offset, QuantiserScale scale,
              std::span<std::uint8_t> video) noexcept;

// Twin of detect_and_quantise in double with libm.
void detect_and_quantise_reference(std::span<const float> power, std::span<const float> offset,
                                   NoiseKey key, QuantiserScale scale, std::span<double> video);

}  // namespace skerry::echo
