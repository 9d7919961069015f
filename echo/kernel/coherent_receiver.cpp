#include "echo/kernel/coherent_receiver.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// Two squares and what lies beside: never negative, at least 0, where fast_log2 is -127.
template <bool kBeside>
inline __attribute__((always_inline)) float total_power(float power, float gain,
                                                        const NoiseRow& noise, std::size_t i) {
  const float in_phase =
      (noise.re_a[i] - noise.im_b[i]) + (noise.re_c[i] + std::sqrt(power * gain));
  const float quadrature = (noise.im_a[i] + noise.re_b[i]) - noise.im_c[i];
  const float total = in_phase * in_phase + quadrature * quadrature;
  return kBeside ? total + noise.beside[i] : total;
}

// scale.per_octave * (log2(x) + raised) + offset, with fast_log2's polynomial: log2 of 2^n m is n,
// which is the bits of x as a number of 2^-23, plus log2(m) - (m - 1) = t (1 - t) q(t), t = m - 1,
// multiplied out in powers of m with all that is constant in the first of them.  Error: fast_log2's
// and 2e-5 octaves of rounding.
struct LogScale {
  LogScale(QuantiserScale scale, float raised)
      : top(scale.top), slope(scale.per_octave * 0x1p-23f) {
    constexpr double a = 0.0821305896, b = -0.239058108, c = 0.438725708;
    // t (1 - t) (a t^2 + b t + c) by powers of t, then of t + 1.
    constexpr double t1 = c, t2 = b - c, t3 = a - b, t4 = -a;
    constexpr double m0 = -t1 + t2 - t3 + t4, m1 = t1 - 2.0 * t2 + 3.0 * t3 - 4.0 * t4;
    constexpr double m2 = t2 - 3.0 * t3 + 6.0 * t4, m3 = t3 - 4.0 * t4, m4 = t4;
    const double per_octave = scale.per_octave;
    terms[0] = static_cast<float>(per_octave * (m0 - 127.0 + raised));
    terms[1] = static_cast<float>(per_octave * m1), terms[2] = static_cast<float>(per_octave * m2);
    terms[3] = static_cast<float>(per_octave * m3), terms[4] = static_cast<float>(per_octave * m4);
  }
  float top, slope;
  float terms[5];
};

inline __attribute__((always_inline)) std::uint8_t quantised(float total, float offset,
                                                             const LogScale& s) {
  const auto bits = std::bit_cast<std::int32_t>(total);
  const float m = std::bit_cast<float>((bits & 0x007FFFFF) | 0x3F800000);
  const float rest =
      (((s.terms[4] * m + s.terms[3]) * m + s.terms[2]) * m + s.terms[1]) * m + s.terms[0];
  float v = (s.slope * static_cast<float>(bits) + offset) + rest;
  v = v > 0.0f ? v : 0.0f;
  v = v < s.top ? v : s.top;
  return static_cast<std::uint8_t>(static_cast<std::int32_t>(v));
}

inline __attribute__((always_inline)) float larger(float a, float b) { return a > b ? a : b; }

enum class Sum { none, groups, few };

// Rows of stages that are off are null.
template <bool kReject, Sum kSum, bool kBeside>
inline __attribute__((always_inline)) void receive_loop(
    const float* __restrict power, float gain, const NoiseRow noise, const float* __restrict before,
    const float* __restrict before_that, float* __restrict raw, float ratio, float floor,
    const float* __restrict later, float* __restrict so_far, float* __restrict kept,
    const float* __restrict past_a, const float* __restrict past_b, const float* __restrict past_c,
    const float* __restrict offset, const LogScale scale, std::uint8_t* __restrict video,
    std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    float total = total_power<kBeside>(power[i], gain, noise, i);
    if constexpr (kReject) {
      raw[i] = total;
      const float neighbour = larger(before[i], before_that[i]);
      total = total > ratio * larger(neighbour, floor) ? neighbour : total;
    }
    if constexpr (kSum == Sum::groups) {
      const float sum = so_far[i] + total;
      so_far[i] = sum;
      kept[i] = total;
      total = sum + later[i];
    }
    if constexpr (kSum == Sum::few) {
      kept[i] = total;
      total = ((total + past_a[i]) + past_b[i]) + past_c[i];
    }
    video[i] = quantised(total, offset[i], scale);
  }
}

#define SKERRY_RECEIVE_LOOP(reject, sum, beside)                                                   \
  receive_loop<reject, sum, beside>(power, gain, noise, rejection.before, rejection.before_that,   \
                                    rejection.total, rejection.ratio, rejection.floor,             \
                                    integration.later, integration.so_far, integration.kept,       \
                                    integration.past[0], integration.past[1], integration.past[2], \
                                    offset, LogScale(scale, integration.octaves), video, n)

#define SKERRY_RECEIVE_KERNEL(name, reject, sum)                                                   \
  SKERRY_KERNEL_BODY name##_body(const float* __restrict power, float gain, const NoiseRow& noise, \
                                 const RejectionRows& rejection,                                   \
                                 const IntegrationRows& integration,                               \
                                 const float* __restrict offset, QuantiserScale scale,             \
                                 std::uint8_t* __restrict video, std::size_t n) {                  \
    if (noise.beside != nullptr) {                                                                 \
      SKERRY_RECEIVE_LOOP(reject, sum, true);                                                      \
    } else {                                                                                       \
      SKERRY_RECEIVE_LOOP(reject, sum, false);                                                     \
    }                                                                                              \
  }                                                                                                \
  SKERRY_KERNEL(name,                                                                              \
                (const float* __restrict power, float gain, const NoiseRow& noise,                 \
                 const RejectionRows& rejection, const IntegrationRows& integration,               \
                 const float* __restrict offset, QuantiserScale scale,                             \
                 std::uint8_t* __restrict video, std::size_t n),                                   \
                (power, gain, noise, rejection, integration, offset, scale, video, n))

SKERRY_RECEIVE_KERNEL(receive_plain, false, Sum::none)
SKERRY_RECEIVE_KERNEL(receive_with_rejection, true, Sum::none)
SKERRY_RECEIVE_KERNEL(receive_with_groups, false, Sum::groups)
SKERRY_RECEIVE_KERNEL(receive_with_few, false, Sum::few)
SKERRY_RECEIVE_KERNEL(receive_rejected_with_groups, true, Sum::groups)
SKERRY_RECEIVE_KERNEL(receive_rejected_with_few, true, Sum::few)
#undef SKERRY_RECEIVE_KERNEL
#undef SKERRY_RECEIVE_LOOP

template <bool kBeside>
inline __attribute__((always_inline)) void power_loop(const float* __restrict power, float gain,
                                                      const NoiseRow noise, float* __restrict total,
                                                      std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) total[i] = total_power<kBeside>(power[i], gain, noise, i);
}
SKERRY_KERNEL_BODY power_rows_body(const float* __restrict power, float gain, const NoiseRow& noise,
                                   float* __restrict total, std::size_t n) {
  if (noise.beside != nullptr) {
    power_loop<true>(power, gain, noise, total, n);
  } else {
    power_loop<false>(power, gain, noise, total, n);
  }
}
SKERRY_KERNEL(power_rows,
              (const float* __restrict power, float gain, const NoiseRow& noise,
               float* __restrict total, std::size_t n),
              (power, gain, noise, total, n))

SKERRY_KERNEL_BODY add_rows_body(float* __restrict sum, const float* __restrict row,
                                 std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += row[i];
}
SKERRY_KERNEL(add_rows, (float* __restrict sum, const float* __restrict row, std::size_t n),
              (sum, row, n))

// 128 octaves up, so that rounding to zero is rounding down.
template <bool kBeside>
inline __attribute__((always_inline)) void level_loop(const float* __restrict power, float gain,
                                                      const NoiseRow noise,
                                                      std::int32_t* __restrict sums,
                                                      std::size_t bins) {
  for (std::size_t b = 0; b < bins; ++b) {
    std::int32_t sum = 0;
    const std::size_t begin = b * kLevelCells;
    for (std::size_t k = 0; k < kLevelCells; ++k) {
      const std::size_t i = begin + k;
      const float total = total_power<kBeside>(power[i], gain, noise, i);
      sum += static_cast<std::int32_t>((fast_log2(total) + 128.0f) * 256.0f);
    }
    sums[b] = sum - static_cast<std::int32_t>(kLevelCells) * 128 * 256;
  }
}
SKERRY_KERNEL_BODY level_sums_body(const float* __restrict power, float gain, const NoiseRow& noise,
                                   std::int32_t* __restrict sums, std::size_t bins) {
  if (noise.beside != nullptr) {
    level_loop<true>(power, gain, noise, sums, bins);
  } else {
    level_loop<false>(power, gain, noise, sums, bins);
  }
}
SKERRY_KERNEL(level_sums,
              (const float* __restrict power, float gain, const NoiseRow& noise,
               std::int32_t* __restrict sums, std::size_t bins),
              (power, gain, noise, sums, bins))

}  // namespace

void receive_video(std::span<const float> power, float gain, const NoiseRow& noise,
                   std::span<const float> offset, QuantiserScale scale,
                   std::span<std::uint8_t> video) noexcept {
  receive_plain(power.data(), gain, noise, {}, {}, offset.data(), scale, video.data(),
                video.size());
}

void receive_power(std::span<const float> power, float gain, const NoiseRow& noise,
                   std::span<float> total) noexcept {
  power_rows(power.data(), gain, noise, total.data(), total.size());
}

void receive_rejected(std::span<const float> power, float gain, const NoiseRow& noise,
                      const RejectionRows& rejection, std::span<const float> offset,
                      QuantiserScale scale, std::span<std::uint8_t> video) noexcept {
  receive_with_rejection(power.data(), gain, noise, rejection, {}, offset.data(), scale,
                         video.data(), video.size());
}

void receive_integrated(std::span<const float> power, float gain, const NoiseRow& noise,
                        const IntegrationRows& integration, std::span<const float> offset,
                        QuantiserScale scale, std::span<std::uint8_t> video) noexcept {
  const auto receive = integration.so_far != nullptr ? receive_with_groups : receive_with_few;
  receive(power.data(), gain, noise, {}, integration, offset.data(), scale, video.data(),
          video.size());
}

void receive_rejected_and_integrated(std::span<const float> power, float gain,
                                     const NoiseRow& noise, const RejectionRows& rejection,
                                     const IntegrationRows& integration,
                                     std::span<const float> offset, QuantiserScale scale,
                                     std::span<std::uint8_t> video) noexcept {
  const auto receive =
      integration.so_far != nullptr ? receive_rejected_with_groups : receive_rejected_with_few;
  receive(power.data(), gain, noise, rejection, integration, offset.data(), scale, video.data(),
          video.size());
}

void add_row(std::span<float> sum, std::span<const float> row) noexcept {
  add_rows(sum.data(), row.data(), sum.size());
}

void sum_levels(std::span<const float> power, float gain, const NoiseRow& noise,
                std::span<std::int32_t> sums) noexcept {
  level_sums(power.data(), gain, noise, sums.data(), sums.size());
}

double total_power_reference(double power, double gain, const NoiseRow& noise, std::size_t cell) {
  const auto at = [cell](const float* row) { return static_cast<double>(row[cell]); };
  const double in_phase =
      at(noise.re_a) - at(noise.im_b) + at(noise.re_c) + std::sqrt(power * gain);
  const double quadrature = at(noise.im_a) + at(noise.re_b) - at(noise.im_c);
  const double beside = noise.beside != nullptr ? at(noise.beside) : 0.0;
  return in_phase * in_phase + quadrature * quadrature + beside;
}

double rejected_reference(double total, double before, double before_that, double ratio,
                          double floor) {
  const double neighbour = std::max(before, before_that);
  return total > ratio * std::max(neighbour, floor) ? neighbour : total;
}

double video_reference(double total, double offset, QuantiserScale scale) {
  const double value = static_cast<double>(scale.per_octave) * std::log2(total) + offset;
  return std::clamp(value, 0.0, static_cast<double>(scale.top));
}

}  // namespace skerry::echo
