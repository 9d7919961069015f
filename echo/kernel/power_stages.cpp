#include "echo/kernel/power_stages.hpp"

#include <cstddef>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {

namespace {

SKERRY_KERNEL_BODY most_of_body(float* most, const float* row, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) most[i] = most[i] > row[i] ? most[i] : row[i];
}
SKERRY_KERNEL(most_of, (float* __restrict most, const float* __restrict row, std::size_t n),
              (most, row, n))

// Denormal powers would make the quotient run away.
SKERRY_KERNEL_BODY sharpen_body(float* row, const float* most, float c0, float c1, float c2,
                                float c3, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float t = row[i] / (most[i] > 1e-30f ? most[i] : 1e-30f);
    row[i] *= ((c3 * t + c2) * t + c1) * t + c0;
  }
}
SKERRY_KERNEL(sharpen,
              (float* __restrict row, const float* __restrict most, float c0, float c1, float c2,
               float c3, std::size_t n),
              (row, most, c0, c1, c2, c3, n))

SKERRY_KERNEL_BODY suppress_body(float* row, const float* power, const float* a, const float* b,
                                 float share, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float strongest = a[i] > b[i] ? a[i] : b[i];
    row[i] = power[i] < share * strongest ? 0.0f : row[i];
  }
}
SKERRY_KERNEL(suppress,
              (float* __restrict row, const float* power, const float* __restrict a,
               const float* __restrict b, float share, std::size_t n),
              (row, power, a, b, share, n))

SKERRY_KERNEL_BODY boost_body(float* row, float more, float knee, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float p = row[i];
    row[i] = p + more * p * (p / (1.0f + p)) * (knee / (knee + p));
  }
}
SKERRY_KERNEL(boost, (float* row, float more, float knee, std::size_t n), (row, more, knee, n))

SKERRY_KERNEL_BODY gate_body(std::uint8_t* video, const std::uint8_t* least, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    video[i] = video[i] < least[i] ? std::uint8_t{0} : video[i];
  }
}
SKERRY_KERNEL(gate,
              (std::uint8_t* __restrict video, const std::uint8_t* __restrict least, std::size_t n),
              (video, least, n))

}  // namespace

void keep_most(std::span<float> most, std::span<const float> row) noexcept {
  most_of(most.data(), row.data(), most.size());
}

void sharpen_row(std::span<float> row, std::span<const float> most, SharpeningLaw law) noexcept {
  sharpen(row.data(), most.data(), law[0], law[1], law[2], law[3], row.size());
}

void suppress_row(std::span<float> row, std::span<const float> power, std::span<const float> a,
                  std::span<const float> b, float share) noexcept {
  suppress(row.data(), power.data(), a.data(), b.data(), share, row.size());
}

void boost_row(std::span<float> row, float more, float knee) noexcept {
  boost(row.data(), more, knee, row.size());
}

void gate_video(std::span<std::uint8_t> video, std::span<const std::uint8_t> least) noexcept {
  gate(video.data(), least.data(), video.size());
}

double sharpened_reference(double power, double most, SharpeningLaw law) {
  if (most <= 0.0) return power;
  const double t = power / most;
  double sum = 0.0, term = 1.0;
  for (const float c : law) {
    sum += static_cast<double>(c) * term;
    term *= t;
  }
  return power * sum;
}

double boosted_reference(double power, double more, double knee) {
  return power * (1.0 + more * power / (1.0 + power) * knee / (knee + power));
}

namespace {

SKERRY_KERNEL_BODY scale_body(float* row, float factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] *= factor;
}
SKERRY_KERNEL(scale, (float* row, float factor, std::size_t n), (row, factor, n))

}  // namespace

void scale_row(std::span<float> row, float factor) noexcept {
  scale(row.data(), factor, row.size());
}

}  // namespace skerry::echo
