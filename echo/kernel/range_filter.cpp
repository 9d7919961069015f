#include "echo/kernel/range_filter.hpp"

#include <algorithm>

#include "echo/kernel/isa.hpp"
#include "echo/kernel/pulse_stretch.hpp"

namespace skerry::echo {
namespace {

constexpr std::size_t kCellsFiltered = 64;

// out[i] = sum of taps[k] * in[i - k * apart]; `in` has room for all taps before it.  Sums stay in
// registers while the taps pass.
SKERRY_KERNEL_BODY filter_taps_body(const float* __restrict in, const float* __restrict taps,
                                    std::size_t count, std::size_t apart, float* __restrict out,
                                    std::size_t n) {
  for (std::size_t begin = 0; begin < n; begin += kCellsFiltered) {
    float sum[kCellsFiltered] = {};
    for (std::size_t k = 0; k < count; ++k) {
      const float* __restrict from = in + begin - k * apart;
      const float tap = taps[k];
      for (std::size_t i = 0; i < kCellsFiltered; ++i) sum[i] = sum[i] + tap * from[i];
    }
    const std::size_t cells = n - begin < kCellsFiltered ? n - begin : kCellsFiltered;
    for (std::size_t i = 0; i < cells; ++i) out[begin + i] = sum[i];
  }
}
SKERRY_KERNEL(filter_taps,
              (const float* __restrict in, const float* __restrict taps, std::size_t count,
               std::size_t apart, float* __restrict out, std::size_t n),
              (in, taps, count, apart, out, n))

}  // namespace

void filter_range(std::span<float> power, std::span<const float> taps, std::uint32_t tap_cells,
                  std::uint32_t lead, std::vector<float>& scratch) {
  thread_local std::vector<float> boxes;
  const std::size_t before = taps.size() * tap_cells;
  scratch.assign(before + power.size() + lead + kCellsFiltered, 0.0f);
  float* const row = scratch.data() + before;
  std::copy(power.begin(), power.end(), row);
  if (tap_cells > 1) stretch_pulse({row, power.size() + lead}, tap_cells, boxes);
  filter_taps(row + lead, taps.data(), taps.size(), tap_cells, power.data(), power.size());
}

void filter_range_reference(std::span<const float> power, std::span<const float> taps,
                            std::uint32_t tap_cells, std::uint32_t lead, std::span<double> out) {
  for (std::size_t i = 0; i < power.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < taps.size() * tap_cells && k <= i + lead; ++k) {
      const std::size_t from = i + lead - k;
      if (from < power.size())
        sum += static_cast<double>(taps[k / tap_cells]) * static_cast<double>(power[from]);
    }
    out[i] = sum;
  }
}

}  // namespace skerry::echo
