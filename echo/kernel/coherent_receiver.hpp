// The receiver's hot loops where noise has phase: noise, interference rejection, pulse integration,
// log detector, gain and STC, quantiser, in one pass over the cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "echo/kernel/log_receiver.hpp"

namespace skerry::echo {

// Noise of one spoke as a complex number per cell,
// n = a + j b + conj(c), and a power beside it that has no phase to the echo (what
// the other samples of a coarse cell leave).  Each points to as many cells as are received.
struct NoiseRow {
  const float* re_a = nullptr;
  const float* im_a = nullptr;
  const float* re_b = nullptr;
  const float* im_b = nullptr;
  const float* re_c = nullptr;
  const float* im_c = nullptr;
  const float* beside = nullptr;  // >= 0; null: none
};

// The row from cell `begin` on.
inline NoiseRow from_cell(const NoiseRow& noise, std::size_t begin) {
  return {noise.re_a + begin,
          noise.im_a + begin,
          noise.re_b + begin,
          noise.im_b + begin,
          noise.re_c + begin,
          noise.im_c + begin,
          noise.beside != nullptr ? noise.beside + begin : nullptr};
}

// A cell's power behind a square-law detector: |sqrt(gain * power) + n|^2 + beside.  power: echo
// over receiver noise, >= 0, finite.  The echo's own phase is left out: n is the same from all
// sides.  With unit noise a steady echo is Rician, an exponential one stays exponential.
//
// video[i] = clamp(per_octave * log2(that) + offset[i], 0, top), rounded down.
// Error: kFastLog2Error * per_octave before rounding, held by
// CoherentReceiver.MatchesItsReferenceAtEveryLengthAndOffset.
void receive_video(std::span<const float> power, float gain, const NoiseRow& noise,
                   std::span<const float> offset, QuantiserScale scale,
                   std::span<std::uint8_t> video) noexcept;

// The same without log and quantiser.  Error: 3e-7 relative to (sqrt(gain * power) + |n|)^2.
void receive_power(std::span<const float> power, float gain, const NoiseRow& noise,
                   std::span<float> total) noexcept;

// Interference rejection: what one spoke keeps for those after it.
struct RejectionRows {
  const float* before = nullptr;       // total power of the spoke before
  const float* before_that = nullptr;  // and of the one before that
  float* total = nullptr;              // out: of this spoke, not rejected
  float ratio = 1.0f;                  // > 1
  float floor = 1.0f;                  // no power below ratio * floor is rejected
};

// Integration: the mean of the last k spokes, always summed anew, so that a strong echo leaves
// nothing behind.  Either spokes come in groups of k: `later` holds the sum over the spokes of the
// group before that are not yet k old, `so_far` the sum over this group.  Or there are few,
// `so_far` is null, and `past` holds each of those before, nearest first; rows of zeros stand for
// none.
inline constexpr std::size_t kFewPast = 3;
struct IntegrationRows {
  const float* later = nullptr;
  float* so_far = nullptr;  // in and out: this spoke is added
  float* kept = nullptr;    // out: this spoke alone
  float octaves = 0.0f;     // log2 of 1 / number of spokes summed
  std::array<const float*, kFewPast> past = {};
};

// receive_video with one or both between detector and log.  A cell more than `ratio` times the
// larger of the two spokes before (and of `floor`) gets that larger power.
// The rows do not overlap each other.
void receive_rejected(std::span<const float> power, float gain, const NoiseRow& noise,
                      const RejectionRows& rejection, std::span<const float> offset,
                      QuantiserScale scale, std::span<std::uint8_t> video) noexcept;
void receive_integrated(std::span<const float> power, float gain, const NoiseRow& noise,
                        const IntegrationRows& integration, std::span<const float> offset,
                        QuantiserScale scale, std::span<std::uint8_t> video) noexcept;
void receive_rejected_and_integrated(std::span<const float> power, float gain,
                                     const NoiseRow& noise, const RejectionRows& rejection,
                                     const IntegrationRows& integration,
                                     std::span<const float> offset, QuantiserScale scale,
                                     std::span<std::uint8_t> video) noexcept;

// sum[i] += row[i].  No overlap.
void add_row(std::span<float> sum, std::span<const float> row) noexcept;

// sums[b] = sum over the kLevelCells cells of bin b of log2(total), in steps of 1/256 octave
// rounded down.  total >= 2^-127.  Requires power.size() >= kLevelCells * sums.size().
inline constexpr std::size_t kLevelCells = 16;
void sum_levels(std::span<const float> power, float gain, const NoiseRow& noise,
                std::span<std::int32_t> sums) noexcept;

// Twins in double with libm.
double total_power_reference(double power, double gain, const NoiseRow& noise, std::size_t cell);
double rejected_reference(double total, double before, double before_that, double ratio,
                          double floor);
double video_reference(double total, double offset, QuantiserScale scale);

}  // namespace skerry::echo
