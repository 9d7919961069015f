#include "echo/kernel/sweep_codes.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY blend_body(const float* __restrict before, const float* __restrict after,
                              float share, float* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = before[i] + share * (after[i] - before[i]);
}
SKERRY_KERNEL(blend,
              (const float* __restrict before, const float* __restrict after, float share,
               float* __restrict out, std::size_t n),
              (before, after, share, out, n))

SKERRY_KERNEL_BODY sample_body(const float* __restrict cells, float first, float step,
                               float* __restrict out, std::int32_t n) {
  for (std::int32_t i = 0; i < n; ++i) {
    const float place = first + static_cast<float>(i) * step;
    const auto at = static_cast<std::int32_t>(place);
    const float near = cells[at];
    out[i] = near + (place - static_cast<float>(at)) * (cells[at + 1] - near);
  }
}
SKERRY_KERNEL(sample,
              (const float* __restrict cells, float first, float step, float* __restrict out,
               std::int32_t n),
              (cells, first, step, out, n))

inline __attribute__((always_inline)) std::uint16_t code_of(float v, float top, std::int32_t flip) {
  v = v > 0.0f ? v : 0.0f;
  v = v < top ? v : top;
  return static_cast<std::uint16_t>(static_cast<std::int32_t>(v) ^ flip);
}

SKERRY_KERNEL_BODY log_codes_body(const float* __restrict power, float per_octave,
                                  const float* __restrict offset, float top, std::int32_t flip,
                                  std::uint16_t* __restrict codes, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    codes[i] = code_of(per_octave * fast_log2(power[i]) + offset[i], top, flip);
}
SKERRY_KERNEL(log_codes,
              (const float* __restrict power, float per_octave, const float* __restrict offset,
               float top, std::int32_t flip, std::uint16_t* __restrict codes, std::size_t n),
              (power, per_octave, offset, top, flip, codes, n))

SKERRY_KERNEL_BODY linear_codes_body(const float* __restrict power, const float* __restrict factor,
                                     float offset, float top, std::int32_t flip,
                                     std::uint16_t* __restrict codes, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    codes[i] = code_of(factor[i] * std::sqrt(power[i]) + offset, top, flip);
}
SKERRY_KERNEL(linear_codes,
              (const float* __restrict power, const float* __restrict factor, float offset,
               float top, std::int32_t flip, std::uint16_t* __restrict codes, std::size_t n),
              (power, factor, offset, top, flip, codes, n))

enum class Take { peak, mean, sum };

template <Take kTake>
inline __attribute__((always_inline)) std::uint16_t taken(std::uint32_t value,
                                                          std::uint32_t group) {
  if constexpr (kTake == Take::mean) value = (value + group / 2) / group;
  if constexpr (kTake == Take::sum) value = value < 65535u ? value : 65535u;
  return static_cast<std::uint16_t>(value);
}

template <Take kTake>
inline __attribute__((always_inline)) std::uint32_t joined(std::uint32_t a, std::uint32_t b) {
  if constexpr (kTake == Take::peak) return a > b ? a : b;
  return a + b;
}

// A group of known size is unrolled, and the loop over groups vectorised.
template <Take kTake, std::uint32_t kGroup>
inline __attribute__((always_inline)) void small_groups(const std::uint16_t* __restrict codes,
                                                        std::uint16_t* __restrict out,
                                                        std::size_t n) {
  for (std::size_t g = 0; g < n; ++g) {
    std::uint32_t value = codes[g * kGroup];
    for (std::uint32_t k = 1; k < kGroup; ++k) value = joined<kTake>(value, codes[g * kGroup + k]);
    out[g] = taken<kTake>(value, kGroup);
  }
}

template <Take kTake>
inline __attribute__((always_inline)) void any_groups(const std::uint16_t* __restrict codes,
                                                      std::uint32_t group,
                                                      std::uint16_t* __restrict out,
                                                      std::size_t n) {
  if (group == 2) return small_groups<kTake, 2>(codes, out, n);
  if (group == 4) return small_groups<kTake, 4>(codes, out, n);
  if (group == 8) return small_groups<kTake, 8>(codes, out, n);
  for (std::size_t g = 0; g < n; ++g) {
    const std::uint16_t* begin = codes + g * group;
    std::uint32_t value = begin[0];
    for (std::uint32_t k = 1; k < group; ++k) value = joined<kTake>(value, begin[k]);
    out[g] = taken<kTake>(value, group);
  }
}

#define SKERRY_DECIMATION(name, take)                                                        \
  SKERRY_KERNEL_BODY name##_body(const std::uint16_t* __restrict codes, std::uint32_t group, \
                                 std::uint16_t* __restrict out, std::size_t n) {             \
    any_groups<take>(codes, group, out, n);                                                  \
  }                                                                                          \
  SKERRY_KERNEL(name,                                                                        \
                (const std::uint16_t* __restrict codes, std::uint32_t group,                 \
                 std::uint16_t* __restrict out, std::size_t n),                              \
                (codes, group, out, n))

SKERRY_DECIMATION(peaks, Take::peak)
SKERRY_DECIMATION(means, Take::mean)
SKERRY_DECIMATION(sums, Take::sum)
#undef SKERRY_DECIMATION

}  // namespace

void blend_rows(std::span<const float> before, std::span<const float> after, float share,
                std::span<float> out) noexcept {
  blend(before.data(), after.data(), share, out.data(), out.size());
}

void sample_row(std::span<const float> cells, float first, float step,
                std::span<float> out) noexcept {
  sample(cells.data(), first, step, out.data(), static_cast<std::int32_t>(out.size()));
}

void convert_log(std::span<const float> power, float per_octave, std::span<const float> offset,
                 ConverterScale scale, std::span<std::uint16_t> codes) noexcept {
  log_codes(power.data(), per_octave, offset.data(), scale.top,
            static_cast<std::int32_t>(scale.flip), codes.data(), codes.size());
}

void convert_linear(std::span<const float> power, std::span<const float> factor, float offset,
                    ConverterScale scale, std::span<std::uint16_t> codes) noexcept {
  linear_codes(power.data(), factor.data(), offset, scale.top,
               static_cast<std::int32_t>(scale.flip), codes.data(), codes.size());
}

void decimate_by_peak(std::span<const std::uint16_t> codes, std::uint32_t group,
                      std::span<std::uint16_t> out) noexcept {
  peaks(codes.data(), group, out.data(), out.size());
}
void decimate_by_mean(std::span<const std::uint16_t> codes, std::uint32_t group,
                      std::span<std::uint16_t> out) noexcept {
  means(codes.data(), group, out.data(), out.size());
}
void decimate_by_sum(std::span<const std::uint16_t> codes, std::uint32_t group,
                     std::span<std::uint16_t> out) noexcept {
  sums(codes.data(), group, out.data(), out.size());
}

double sample_row_reference(std::span<const float> cells, double place) {
  const double below = std::floor(place), share = place - below;
  const auto at = static_cast<std::size_t>(below);
  return (1.0 - share) * static_cast<double>(cells[at]) +
         share * static_cast<double>(cells[std::min(at + 1, cells.size() - 1)]);
}

double convert_log_reference(double power, double per_octave, double offset) {
  return per_octave * std::log2(power) + offset;
}

double convert_linear_reference(double power, double factor, double offset) {
  return factor * std::sqrt(power) + offset;
}

}  // namespace skerry::echo
