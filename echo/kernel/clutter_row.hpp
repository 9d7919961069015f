// One row of sea clutter: a Gaussian field sampled along the spoke, bent to the gamma law and laid
// over the cells; and what adds clutter to power.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/moved_row.hpp"

namespace skerry::echo {

// A straight way over a ring of values (echo/clutter/lattice_field.hpp), from the value
// ring[origin]: sample s is the one nearest to `along + s * along_step` on along, `across + s *
// across_step` across.
struct FieldWalk {
  std::uint32_t origin = 0;
  float along = 0.0f, across = 0.0f;  // -1 to 1
  float along_step = 0.0f, across_step = 0.0f;
  float weight = 1.0f;
};
// A ring in steps of kPackedStep, four values to a word, so that it fits into the second-level
// cache.  Beyond +-127 steps it is cut; values.size() is a power of two.  Error: half a step.
inline constexpr float kPackedStep = 0.0375f;
std::vector<std::uint32_t> packed_ring(std::span<const float> values);

// out[s] = a.weight * value on a's way + b.weight * value on b's at sample first + s.  ring: a
// packed_ring; `stride` values further on the ring is one across.  Error: half a step of either
// value; a place within 1e-3 of half-way may go to either side (2e-3 beyond 8192 values from the
// origin).
void walk_field(std::span<const std::uint32_t> ring, std::uint32_t stride, const FieldWalk& a,
                const FieldWalk& b, std::uint32_t first, std::span<float> out) noexcept;
void walk_field_reference(std::span<const float> ring, std::uint32_t stride, const FieldWalk& a,
                          const FieldWalk& b, std::span<double> out);

// log2 of a unit-mean positive value with the rank of a Gaussian one: a polynomial in
// t = slope * clamp(x, low, high) + offset, |t| <= 1.
struct RankLaw {
  float low = -4.5f, high = 4.5f;
  float slope = 1.0f / 4.5f, offset = 0.0f;
  std::array<float, 7> terms = {};  // of t^0, t^1, ...
};
inline constexpr std::size_t kSamplesPerLaw = 32;

// A row between two others whose values correlate as 2^(-decay * apart2[s]).  Requires 0 <= decay *
// apart2[s] <= 120.
struct TextureMix {
  std::span<const float> first, second;  // Gaussian, unit variance
  float share = 0.0f;                    // of the second, 0 to 1
  std::span<const float> apart2;         // squared distance between their samples, m2
  float decay = 0.0f;                    // octaves per m2
  std::span<const float> spread;         // octaves added at ...
  float spread_share = 0.0f;             // ... this, -1 to 1
};
// octaves[s] = laws[s / 32] at x + spread_share * spread[s], where x is the mixture of first and
// second brought back to unit variance.  Error: 3e-3 octaves (0.01 dB) against the double
// reference, for the laws of echo/clutter/gamma_law.hpp.  Held by
// ClutterRow.TextureIsThatOfItsReference.
void texture_octaves(const TextureMix& mix, std::span<const RankLaw> laws,
                     std::span<float> octaves) noexcept;
void texture_octaves_reference(const TextureMix& mix, std::span<const RankLaw> laws,
                               std::span<double> octaves);

// A wave along the row: octaves[s] += height cos(2 pi (phase + s step)) - mean, height and mean
// from block s / 32.  Error: 1.2e-3 of the height.  Held by ClutterRow.WaveIsThatOfItsReference.
struct WaveBlock {
  float height = 0.0f, mean = 0.0f;  // octaves
  float lead = 0.0f;                 // turns
};
// blocks and octaves begin at sample `first`, a multiple of kSamplesPerLaw.
void add_wave(std::span<const WaveBlock> blocks, float phase, float step, std::uint32_t first,
              std::span<float> octaves) noexcept;
void add_wave_reference(std::span<const WaveBlock> blocks, double phase, double step,
                        std::span<double> octaves);

// row[i] = mean[i] * (2^octaves joined by straight lines), one sample each `cells` (1, 2, 4, 8 or
// 16) cells, the first at cell 0.  Spoils octaves, which holds at least row.size() / cells + 2
// samples, each within +-60.  What comes out below 1e-7 is 0.  Error: 3e-5 relative.
void lay_texture(std::span<float> octaves, std::uint32_t cells, std::span<const float> mean,
                 std::span<float> row) noexcept;
void lay_texture_reference(std::span<const float> octaves, std::uint32_t cells,
                           std::span<const float> mean, std::span<double> row);

// power[i] += (first[i] + share (second[i] - first[i])) * speckle[i], for begin <= i < end <=
// power.size(); cells beside them are left as they are, but read and written: no two calls at once
// may be closer than 16 cells.  The other rows are as long as power.  Error: float roundings.
void add_speckled(std::span<const float> first, std::span<const float> second, float share,
                  std::span<const PackedPower> speckle, std::span<float> power, std::size_t begin,
                  std::size_t end) noexcept;

}  // namespace skerry::echo
