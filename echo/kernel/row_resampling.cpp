#include "echo/kernel/row_resampling.hpp"

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// The first and the last cell are made outside the loop.
SKERRY_KERNEL_BODY double_inner_body(const float* __restrict in, float* __restrict out,
                                     std::size_t n) {
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const float most = 0.75f * in[k];
    out[2 * k] = 0.25f * in[k - 1] + most;
    out[2 * k + 1] = most + 0.25f * in[k + 1];
  }
}
SKERRY_KERNEL(double_inner, (const float* __restrict in, float* __restrict out, std::size_t n),
              (in, out, n))

SKERRY_KERNEL_BODY halve_peak_body(const float* __restrict in, float* __restrict out,
                                   std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = in[2 * i] > in[2 * i + 1] ? in[2 * i] : in[2 * i + 1];
  }
}
SKERRY_KERNEL(halve_peak, (const float* __restrict in, float* __restrict out, std::size_t n),
              (in, out, n))

SKERRY_KERNEL_BODY halve_mean_body(const float* __restrict in, float* __restrict out,
                                   std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = 0.5f * (in[2 * i] + in[2 * i + 1]);
}
SKERRY_KERNEL(halve_mean, (const float* __restrict in, float* __restrict out, std::size_t n),
              (in, out, n))

SKERRY_KERNEL_BODY interpolate_body(const float* __restrict in, const std::uint32_t* __restrict at,
                                    const float* __restrict share, float* __restrict out,
                                    std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float near = in[at[i]];
    out[i] = near + share[i] * (in[at[i] + 1] - near);
  }
}
SKERRY_KERNEL(interpolate,
              (const float* __restrict in, const std::uint32_t* __restrict at,
               const float* __restrict share, float* __restrict out, std::size_t n),
              (in, at, share, out, n))

SKERRY_KERNEL_BODY peak_of_body(const float* __restrict in, const std::uint32_t* __restrict at,
                                const std::uint32_t* __restrict last, float* __restrict out,
                                std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float a = in[at[i]], b = in[at[i] + 1], c = in[last[i]];
    const float more = a > b ? a : b;
    out[i] = more > c ? more : c;
  }
}
SKERRY_KERNEL(peak_of,
              (const float* __restrict in, const std::uint32_t* __restrict at,
               const std::uint32_t* __restrict last, float* __restrict out, std::size_t n),
              (in, at, last, out, n))

}  // namespace

void double_cells(std::span<const float> in, std::span<float> out) noexcept {
  const std::size_t n = in.size();
  if (n == 0) return;
  double_inner(in.data(), out.data(), n);
  const auto ends = [&](std::size_t k) {
    const float most = 0.75f * in[k];
    out[2 * k] = 0.25f * in[k > 0 ? k - 1 : k] + most;
    out[2 * k + 1] = most + 0.25f * in[k + 1 < n ? k + 1 : k];
  };
  ends(0);
  ends(n - 1);
}

void halve_cells_by_peak(std::span<const float> in, std::span<float> out) noexcept {
  halve_peak(in.data(), out.data(), out.size());
}

void halve_cells_by_mean(std::span<const float> in, std::span<float> out) noexcept {
  halve_mean(in.data(), out.data(), out.size());
}

void peak_cells(std::span<const float> in, std::span<const std::uint32_t> at,
                std::span<const std::uint32_t> last, std::span<float> out) noexcept {
  peak_of(in.data(), at.data(), last.data(), out.data(), out.size());
}

void interpolate_cells(std::span<const float> in, std::span<const std::uint32_t> at,
                       std::span<const float> share, std::span<float> out) noexcept {
  interpolate(in.data(), at.data(), share.data(), out.data(), out.size());
}

}  // namespace skerry::echo
