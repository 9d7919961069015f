#include "echo/kernel/azimuth_sum.hpp"

#include <algorithm>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// Blocks of cells small enough to stay in the first-level cache while all rays pass over them; four
// rays at a time halve the traffic on `sum` without changing the order of additions.
constexpr std::size_t kCellsSummed = 512;

SKERRY_KERNEL_BODY sum_rays_body(const WeightedRay* rays, std::size_t ray_count,
                                 float* __restrict sum, std::size_t n) {
  for (std::size_t begin = 0; begin < n; begin += kCellsSummed) {
    const std::size_t end = begin + kCellsSummed < n ? begin + kCellsSummed : n;
    for (std::size_t i = begin; i < end; ++i) sum[i] = 0.0f;
    std::size_t r = 0;
    for (; r + 4 <= ray_count; r += 4) {
      const float* __restrict a = rays[r].power;
      const float* __restrict b = rays[r + 1].power;
      const float* __restrict c = rays[r + 2].power;
      const float* __restrict d = rays[r + 3].power;
      const float wa = rays[r].weight, wb = rays[r + 1].weight;
      const float wc = rays[r + 2].weight, wd = rays[r + 3].weight;
      for (std::size_t i = begin; i < end; ++i) {
        sum[i] = (((sum[i] + wa * a[i]) + wb * b[i]) + wc * c[i]) + wd * d[i];
      }
    }
    for (; r < ray_count; ++r) {
      const float* __restrict a = rays[r].power;
      const float wa = rays[r].weight;
      for (std::size_t i = begin; i < end; ++i) sum[i] = sum[i] + wa * a[i];
    }
  }
}

SKERRY_KERNEL(sum_rays,
              (const WeightedRay* rays, std::size_t ray_count, float* __restrict sum,
               std::size_t n),
              (rays, ray_count, sum, n))

}  // namespace

void sum_rays(std::span<const WeightedRay> rays, std::span<float> sum) noexcept {
  sum_rays(rays.data(), rays.size(), sum.data(), sum.size());
}

void sum_rays_reference(std::span<const WeightedRay> rays, std::span<double> sum) {
  std::fill(sum.begin(), sum.end(), 0.0);
  for (const WeightedRay& ray : rays) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += static_cast<double>(ray.weight) * ray.power[i];
    }
  }
}

}  // namespace skerry::echo
