#include "echo/kernel/rain_row.hpp"

#include <algorithm>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

constexpr float kDry = 1e-6f;  // mm/h, added so that a logarithm exists

SKERRY_KERNEL_BODY add_cloud_body(const CloudChord& cloud, float first_m, float step_m,
                                  float* rates, std::size_t n) {
  const float start = first_m - cloud.middle_m, across = cloud.across_squared;
  const float radius = cloud.radius_squared, per = 1.0f / (0.75f * cloud.radius_squared);
  const float rate = cloud.rate_mm_h;
  for (std::size_t j = 0; j < n; ++j) {
    const float along = start + step_m * static_cast<float>(static_cast<std::int32_t>(j));
    float s = (radius - (along * along + across)) * per;
    s = s > 0.0f ? s : 0.0f;
    s = s < 1.0f ? s : 1.0f;
    rates[j] += rate * (s * s * (3.0f - 2.0f * s));
  }
}

SKERRY_KERNEL_BODY rain_losses_body(const float* rates, float log2_k, float alpha, float* losses,
                                    std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    losses[j] = fast_exp2(log2_k + alpha * fast_log2(rates[j] + kDry));
  }
}

SKERRY_KERNEL_BODY power_left_body(float* octaves, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) octaves[j] = fast_exp2(-octaves[j]);
}

template <int kStep>
inline __attribute__((always_inline)) void spread(const float* knots, float* row, std::size_t n) {
  const std::size_t whole = n / kStep;
  for (std::size_t j = 0; j < whole; ++j) {
    const float a = knots[j], slope = (knots[j + 1] - a) * (1.0f / kStep);
    float* const out = row + j * kStep;
    for (int i = 0; i < kStep; ++i) out[i] = a + slope * static_cast<float>(i);
  }
  if (whole * kStep == n) return;
  const float a = knots[whole], slope = (knots[whole + 1] - a) * (1.0f / kStep);
  for (std::size_t i = whole * kStep; i < n; ++i)
    row[i] = a + slope * static_cast<float>(static_cast<std::int32_t>(i - whole * kStep));
}

SKERRY_KERNEL_BODY spread_knots_body(const float* knots, std::size_t step, float* row,
                                     std::size_t n) {
  switch (step) {
    case 1:
      return spread<1>(knots, row, n);
    case 2:
      return spread<2>(knots, row, n);
    case 4:
      return spread<4>(knots, row, n);
    case 8:
      return spread<8>(knots, row, n);
    default:
      return spread<16>(knots, row, n);
  }
}

template <int kStep>
inline __attribute__((always_inline)) void pass(const float* echoes, const float* left,
                                                const float* __restrict level,
                                                const float* __restrict speckle,
                                                float* __restrict power, std::size_t n) {
  const std::size_t whole = n / kStep;
  for (std::size_t j = 0; j < whole; ++j) {
    const float e = echoes[j], more = (echoes[j + 1] - e) * (1.0f / kStep);
    const float t = left[j], less = (left[j + 1] - t) * (1.0f / kStep);
    for (int i = 0; i < kStep; ++i) {
      const std::size_t c = j * kStep + static_cast<std::size_t>(i);
      const auto along = static_cast<float>(i);
      power[c] = (power[c] + level[c] * (e + more * along) * speckle[c]) * (t + less * along);
    }
  }
  if (whole * kStep == n) return;
  const float e = echoes[whole], more = (echoes[whole + 1] - e) * (1.0f / kStep);
  const float t = left[whole], less = (left[whole + 1] - t) * (1.0f / kStep);
  for (std::size_t c = whole * kStep; c < n; ++c) {
    const auto along = static_cast<float>(static_cast<std::int32_t>(c - whole * kStep));
    power[c] = (power[c] + level[c] * (e + more * along) * speckle[c]) * (t + less * along);
  }
}

SKERRY_KERNEL_BODY pass_rain_body(const float* echoes, const float* left, std::size_t step,
                                  const float* level, const float* speckle, float* power,
                                  std::size_t n) {
  switch (step) {
    case 1:
      return pass<1>(echoes, left, level, speckle, power, n);
    case 2:
      return pass<2>(echoes, left, level, speckle, power, n);
    case 4:
      return pass<4>(echoes, left, level, speckle, power, n);
    case 8:
      return pass<8>(echoes, left, level, speckle, power, n);
    default:
      return pass<16>(echoes, left, level, speckle, power, n);
  }
}

SKERRY_KERNEL_BODY fill_row_body(float value, float* row, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] = value;
}

SKERRY_KERNEL(add_cloud,
              (const CloudChord& cloud, float first_m, float step_m, float* __restrict rates,
               std::size_t n),
              (cloud, first_m, step_m, rates, n))
SKERRY_KERNEL(rain_losses,
              (const float* __restrict rates, float log2_k, float alpha, float* __restrict losses,
               std::size_t n),
              (rates, log2_k, alpha, losses, n))
SKERRY_KERNEL(power_left, (float* __restrict octaves, std::size_t n), (octaves, n))
SKERRY_KERNEL(spread_knots,
              (const float* __restrict knots, std::size_t step, float* __restrict row,
               std::size_t n),
              (knots, step, row, n))
SKERRY_KERNEL(pass_rain,
              (const float* __restrict echoes, const float* __restrict left, std::size_t step,
               const float* __restrict level, const float* __restrict speckle,
               float* __restrict power, std::size_t n),
              (echoes, left, step, level, speckle, power, n))
SKERRY_KERNEL(fill_row, (float value, float* __restrict row, std::size_t n), (value, row, n))

}  // namespace

void add_cloud(const CloudChord& cloud, float first_m, float step_m,
               std::span<float> rates) noexcept {
  add_cloud(cloud, first_m, step_m, rates.data(), rates.size());
}

double cloud_rate_reference(const CloudChord& cloud, double at_m) {
  const double along = at_m - static_cast<double>(cloud.middle_m);
  const double squared = along * along + static_cast<double>(cloud.across_squared);
  const double radius = static_cast<double>(cloud.radius_squared);
  const double s = std::clamp((radius - squared) / (0.75 * radius), 0.0, 1.0);
  return static_cast<double>(cloud.rate_mm_h) * s * s * (3.0 - 2.0 * s);
}

void rain_losses(std::span<const float> rates, float log2_k, float alpha,
                 std::span<float> losses) noexcept {
  rain_losses(rates.data(), log2_k, alpha, losses.data(), losses.size());
}

void power_left(std::span<float> octaves) noexcept { power_left(octaves.data(), octaves.size()); }

void spread_knots(std::span<const float> knots, std::size_t step, std::span<float> row) noexcept {
  spread_knots(knots.data(), step, row.data(), row.size());
}

void pass_rain(std::span<const float> echoes, std::span<const float> left, std::size_t step,
               std::span<const float> level, std::span<const float> speckle,
               std::span<float> power) noexcept {
  pass_rain(echoes.data(), left.data(), step, level.data(), speckle.data(), power.data(),
            power.size());
}

void fill_row(float value, std::span<float> row) noexcept {
  fill_row(value, row.data(), row.size());
}

}  // namespace skerry::echo
