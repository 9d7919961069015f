// Natural land along a ray, a chunk of cells at a time: heights, what shows of them, what it
// returns.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "echo/kernel/relief_noise.hpp"

namespace skerry::echo {

inline constexpr double kBankHeight = 4.0;  // of a rocky shore, metres

// Height of the land above the water at `inland` metres behind a rocky shore, given the two noises
// of that place in [-1, 1]: a bank at the edge, a rise over the first half kilometre, and roughness
// that grows inland.  Synthetic: no chart of GSHHG's kind has heights.  Chosen so that the echo's
// thickness and patches are like SOURCES.md "Pictures (c)": echo/returns/README.md.  Grows with
// `broad`, and with `inland` and `fine` where fine >= 0.
template <typename Real>
inline __attribute__((always_inline)) Real natural_height(Real inland, Real broad, Real fine) {
  const Real rise = Real(60.0) * inland / (inland + Real(900.0)) * (Real(1.0) + Real(0.9) * broad);
  const Real steep = Real(0.35) * inland;
  const Real rough = steep < Real(40.0) ? steep : Real(40.0);
  const Real height = Real(kBankHeight) + rise + rough * fine;
  return height > Real(0.5) ? height : Real(0.5);
}

// Land cover varies by place: a factor on gamma by the fine noise, 2^(kCoverOctaves
// noise), so that its logarithm spreads evenly.
inline constexpr float kCoverOctaves = 1.2f;
// Error: 4e-6 relative.
inline __attribute__((always_inline)) float cover_of(float fine_noise) {
  const float x = kCoverOctaves * fine_noise;
  const std::int32_t whole = whole_below(x);
  const float t = x - static_cast<float>(whole);
  const float p =
      (((0.0136703095f * t + 0.0517449978f) * t + 0.241604357f) * t + 0.692972922f) * t +
      1.00000349f;
  return p * std::bit_cast<float>((whole + 127) << 23);
}

inline constexpr std::size_t kLandChunk = 32;
inline constexpr float kHidesNothing = -1e9f;  // a slope

// Cells first .. first + kLandChunk - 1 of a ray, of which first + begin .. first + end - 1 are one
// stretch of natural land.
struct LandChunk {
  std::int32_t first = 0;
  std::int32_t begin = 0, end = 0;
  // Distances of the middle of cell `first`, metres: from the stretch's two ends (negative outside
  // it), and from the antenna.
  float from_begin = 0.0f, from_end = 0.0f, range = 0.0f;
  float cell = 1.0f;
  float antenna = 20.0f;        // height over the water, metres
  float half_curvature = 0.0f;  // 1 / 2 ae
  float horizon = 0.0f;         // sqrt(2 ae antenna)
  float gain = 1.0f;            // power = gain * cover * height shown / range^3
  // The two noises on every 2^coarse_shift-th cell from `first` on, one more than the chunk has.
  const float* broad = nullptr;
  const float* fine = nullptr;
  std::int32_t coarse_shift = 0;
  // Values of the fine noise between those.
  const OctavePath* octaves = nullptr;
  std::size_t octave_count = 0;
  // By cell, where the land has a charted cover: heights of what stands on the ground, and factors
  // on `gain`.  Null: none.  0 and 1 give the bits of none.
  const float* objects = nullptr;
  const float* gains = nullptr;
};

// The chunk's results, by cell.
struct LandChunkOut {
  float height[kLandChunk];  // of the ground over the water
  float shadow[kLandChunk];  // slope below which all nearer land hides, before the cell
  float power[kLandChunk];   // returned; 0 before begin and from end on
};

// Moves `shadow` (the greatest slope of all land before) on behind the chunk.  The coarse noises
// are joined straight.
// Error: heights 1e-3 m, what stands out of the shadow 1e-6 of the range, against double.  Held by
// LandChunk.MatchesItsReference.
void make_land_chunk(const LandChunk& chunk, float& shadow, LandChunkOut& out) noexcept;

// Twin in double, without joining anything: broad and fine noise of each cell are given.
void make_land_chunk_reference(const LandChunk& chunk, const double* broad, const double* fine,
                               double& shadow, double* height, double* power);

}  // namespace skerry::echo
