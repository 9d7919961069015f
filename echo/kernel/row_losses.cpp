#include "echo/kernel/row_losses.hpp"

#include <algorithm>
#include <cstdint>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// Positive floats are ordered as their bits are; integers can be compared in any order.
SKERRY_KERNEL_BODY peak_row_body(const float* power, float* peak, std::size_t n) {
  std::int32_t most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto bits = std::bit_cast<std::int32_t>(power[i]);
    most = bits > most ? bits : most;
  }
  *peak = std::bit_cast<float>(most);
}

inline __attribute__((always_inline)) std::int32_t most_bits(const float* power, std::size_t n) {
  std::int32_t most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto bits = std::bit_cast<std::int32_t>(power[i]);
    most = bits > most ? bits : most;
  }
  return most;
}

SKERRY_KERNEL_BODY block_peaks_body(const float* power, float* peaks, float* peak, std::size_t n) {
  std::int32_t most = 0;
  std::size_t b = 0;
  for (; (b + 1) * kPeakCells <= n; ++b) {
    const std::int32_t bits = most_bits(power + b * kPeakCells, kPeakCells);
    peaks[b] = std::bit_cast<float>(bits);
    most = bits > most ? bits : most;
  }
  if (b * kPeakCells < n) {
    const std::int32_t bits = most_bits(power + b * kPeakCells, n - b * kPeakCells);
    peaks[b] = std::bit_cast<float>(bits);
    most = bits > most ? bits : most;
  }
  *peak = std::bit_cast<float>(most);
}

SKERRY_KERNEL_BODY tilt_row_body(TiltedBeam beam, const float* depression, float* power,
                                 std::size_t n) {
  const float most = -beam.floor / beam.fall;  // square radians at which the floor begins
  for (std::size_t i = 0; i < n; ++i) {
    const float level = depression[i];
    const float off = beam.tilt - level;
    float seen = off * off;
    seen = seen < most ? seen : most;
    float meant = level * level;
    meant = meant < most ? meant : most;
    seen = seen > meant ? seen : meant;
    power[i] *= fast_exp2(beam.fall * (meant - seen));
  }
}

SKERRY_KERNEL_BODY dying_row_body(float loss, const float* dying, float* power, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) power[i] *= fast_exp2(-loss * dying[i]);
}

SKERRY_KERNEL(dying_row,
              (float loss, const float* __restrict dying, float* __restrict power, std::size_t n),
              (loss, dying, power, n))
SKERRY_KERNEL(peak_row, (const float* __restrict power, float* __restrict peak, std::size_t n),
              (power, peak, n))
SKERRY_KERNEL(block_peaks,
              (const float* __restrict power, float* __restrict peaks, float* __restrict peak,
               std::size_t n),
              (power, peaks, peak, n))
SKERRY_KERNEL(tilt_row,
              (TiltedBeam beam, const float* __restrict depression, float* __restrict power,
               std::size_t n),
              (beam, depression, power, n))

}  // namespace

float peak_of(std::span<const float> power) noexcept {
  float peak = 0.0f;
  peak_row(power.data(), &peak, power.size());
  return peak;
}

float peaks_of(std::span<const float> power, std::span<float> peaks) noexcept {
  float peak = 0.0f;
  block_peaks(power.data(), peaks.data(), &peak, power.size());
  return peak;
}

void lose_by_tilt(const TiltedBeam& beam, std::span<const float> depression,
                  std::span<float> power) noexcept {
  tilt_row(beam, depression.data(), power.data(), power.size());
}

void lose_by_tilt_reference(const TiltedBeam& beam, std::span<const float> depression,
                            std::span<double> power) {
  const auto pattern = [&](double off) {
    return std::max(-double{beam.fall} * off * off, double{beam.floor});
  };
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double level = depression[i];
    power[i] *= exact_exp2(std::min(0.0, pattern(beam.tilt - level) - pattern(level)));
  }
}

void lose_dying(float loss, std::span<const float> dying, std::span<float> power) noexcept {
  dying_row(loss, dying.data(), power.data(), power.size());
}

void lose_dying_reference(float loss, std::span<const float> dying, std::span<double> power) {
  for (std::size_t i = 0; i < power.size(); ++i)
    power[i] *= exact_exp2(-double{loss} * double{dying[i]});
}

}  // namespace skerry::echo
