#include "echo/kernel/splat_row.hpp"

#include <algorithm>
#include <vector>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY splat_body(const SplatPoint* __restrict points, std::size_t count,
                              float* __restrict in_phase, float* __restrict quadrature,
                              float* __restrict power, std::size_t width) {
  for (std::size_t i = 0; i < count; ++i) {
    const SplatPoint point = points[i];
    float* __restrict const is = in_phase + point.cell;
    float* __restrict const qs = quadrature + point.cell;
    for (std::size_t c = 0; c < point.cells; c += kSplatLanes) {
      for (std::size_t l = 0; l < kSplatLanes; ++l) {
        is[c + l] += point.shares[c + l] * point.in_phase;
        qs[c + l] += point.shares[c + l] * point.quadrature;
      }
    }
  }
  for (std::size_t c = 0; c < width; ++c)
    power[c] += in_phase[c] * in_phase[c] + quadrature[c] * quadrature[c];
}
SKERRY_NARROW_KERNEL(splat,
                     (const SplatPoint* __restrict points, std::size_t count,
                      float* __restrict in_phase, float* __restrict quadrature,
                      float* __restrict power, std::size_t width),
                     (points, count, in_phase, quadrature, power, width))

}  // namespace

void add_voltages(std::span<const SplatPoint> points, std::span<float> scratch,
                  std::span<float> power) noexcept {
  const std::size_t pitch = power.size() + kSplatLanes;
  std::fill_n(scratch.begin(), 2 * pitch, 0.0f);
  splat(points.data(), points.size(), scratch.data(), scratch.data() + pitch, power.data(),
        power.size());
}

void add_voltages_reference(std::span<const SplatPoint> points, std::span<double> power) {
  std::vector<double> in_phase(power.size()), quadrature(power.size());
  for (const SplatPoint& point : points) {
    for (std::uint32_t c = 0; c < point.cells; ++c) {
      in_phase[point.cell + c] += double{point.shares[c]} * double{point.in_phase};
      quadrature[point.cell + c] += double{point.shares[c]} * double{point.quadrature};
    }
  }
  for (std::size_t c = 0; c < power.size(); ++c)
    power[c] += in_phase[c] * in_phase[c] + quadrature[c] * quadrature[c];
}

}  // namespace skerry::echo
