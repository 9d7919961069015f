#include "echo/kernel/row_factors.hpp"

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
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
