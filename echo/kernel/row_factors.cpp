#include "echo/kernel/row_factors.hpp"

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY multiply_body(float* row, const float* factors, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] *= factors[i];
}
SKERRY_KERNEL(multiply, (float* __restrict row, const float* __restrict factors, std::size_t n),
              (row, factors, n))

SKERRY_KERNEL_BODY scale_body(float* row, float factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] *= factor;
}
SKERRY_KERNEL(scale, (float* row, float factor, std::size_t n), (row, factor, n))

}  // namespace

void multiply_row(std::span<float> row, std::span<const float> factors) noexcept {
  multiply(row.data(), factors.data(), row.size());
}

void scale_row(std::span<float> row, float factor) noexcept {
  scale(row.data(), factor, row.size());
}

}  // namespace skerry::echo
