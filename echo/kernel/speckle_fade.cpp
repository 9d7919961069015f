#include "echo/kernel/speckle_fade.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY fade_body(FadingRows rows, const float* __restrict knots, float last,
                             float to_knot, float low, float high, float* __restrict out,
                             std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float re = rows.share_a * rows.re_a[i] + rows.share_b * rows.re_b[i];
    const float im = rows.share_a * rows.im_a[i] + rows.share_b * rows.im_b[i];
    float at = std::sqrt(re * re + im * im) * to_knot;
    at = at < last ? at : last;
    const auto knot = static_cast<std::int32_t>(at);
    const float from = knots[knot];
    float value = from + (at - static_cast<float>(knot)) * (knots[knot + 1] - from);
    value = value < low ? low : value;
    out[i] = high < value ? high : value;
  }
}
SKERRY_KERNEL(fade,
              (FadingRows rows, const float* __restrict knots, float last, float to_knot, float low,
               float high, float* __restrict out, std::size_t n),
              (rows, knots, last, to_knot, low, high, out, n))

}  // namespace

void fade_speckle(const FadingRows& rows, const RootLaw& law, std::span<float> out) noexcept {
  fade(rows, law.knots.data(), static_cast<float>(law.knots.size() - 2), law.to_knot, law.low,
       law.high, out.data(), out.size());
}

double faded_reference(const FadingRows& rows, const RootLaw& law, std::size_t i) {
  const auto mixed = [&](float a, float b) {
    return static_cast<double>(rows.share_a) * static_cast<double>(a) +
           static_cast<double>(rows.share_b) * static_cast<double>(b);
  };
  const double root =
      std::hypot(mixed(rows.re_a[i], rows.re_b[i]), mixed(rows.im_a[i], rows.im_b[i]));
  const double at =
      std::min(root * static_cast<double>(law.to_knot), static_cast<double>(law.knots.size() - 2));
  const auto knot = static_cast<std::size_t>(at);
  const auto from = static_cast<double>(law.knots[knot]);
  const auto to = static_cast<double>(law.knots[knot + 1]);
  return std::clamp(from + (at - static_cast<double>(knot)) * (to - from),
                    static_cast<double>(law.low), static_cast<double>(law.high));
}

}  // namespace skerry::echo
