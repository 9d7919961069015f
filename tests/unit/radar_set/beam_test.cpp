#include "echo/radar/beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace skerry::echo {
namespace {

double two_way(double angle, double width) {
  return std::pow(cosine_taper_voltage(angle, width), 4);
}

TEST(Beam, HasItsWidthItsNullAndItsSideLobe) {
  for (double width : {0.75, 1.2, 1.9, 5.0}) {
    EXPECT_NEAR(cosine_taper_voltage(0.0, width), 1.0, 1e-12);
    // Half power one way at half the width, within 1 %.
    EXPECT_NEAR(std::pow(cosine_taper_voltage(width / 2, width), 2), 0.5, 0.012) << width;
    double least = 1.0, side_lobe = 0.0;
    for (double a = 0.0; a < 3.0 * width; a += width / 500) {
      const double g = cosine_taper_voltage(a, width);
      if (a < 1.5 * width) least = std::min(least, std::fabs(g));
      if (a > 1.3 * width) side_lobe = std::max(side_lobe, std::fabs(g));
    }
    EXPECT_LT(least, 0.002) << width;
    EXPECT_NEAR(20.0 * std::log10(side_lobe), -23.0, 0.3) << width;
  }
}

TEST(Beam, VoltageIsContinuousWhereTheFormulaIsNot) {
  const double at = std::asin(0.5 * 1.2 / 68.8) * 57.29577951308232;  // mu = pi/2
  EXPECT_NEAR(cosine_taper_voltage(at, 1.2), 0.7853981634, 1e-6);
  EXPECT_NEAR(cosine_taper_voltage(at * 1.0001, 1.2), cosine_taper_voltage(at * 0.9999, 1.2), 1e-3);
}

// The axis on a ray and between two, five to ten rays to a beam, as land is laid
// (static_frame.hpp).
TEST(Beam, LeavesOutLessThanItsBound) {
  for (double width : {0.4, 0.95, 1.2, 1.9, 6.0}) {
    std::uint32_t rays = 256;
    while (rays * width < 5.0 * 360.0) rays *= 2;
    const double step = 360.0 / rays;
    const auto reach = static_cast<std::uint32_t>(1.25 * width / step) + 1;
    double all = 0.0;
    for (double a = -1.25 * width; a < 1.25 * width; a += width / 2000)
      all += two_way(a, width) * width / 2000;
    for (double part : {0.0, 0.5}) {
      const std::vector<float> weights = beam_weights(width, rays, part, reach);
      ASSERT_EQ(weights.size(), 2 * reach + 1);
      double kept = 0.0, first = 1e9, last = -1e9;
      for (std::uint32_t k = 0; k < weights.size(); ++k) {
        const double off = (1.0 * k - reach - part) * step;
        const double weight = static_cast<double>(weights[k]);
        if (weight > 0.0) {
          EXPECT_NEAR(weight / two_way(off, width), 1.0, 1e-6) << width << " deg, " << off;
          first = std::min(first, off), last = std::max(last, off);
          kept += weight * step;
        } else {
          EXPECT_LT(10.0 * std::log10(two_way(off, width) + 1e-30), -40.0) << width << ", " << off;
        }
      }
      EXPECT_NEAR(kept / all, 1.0, 0.01) << width << " deg, axis at " << part;
      double left_out = 0.0;
      for (double a = -1.25 * width; a < 1.25 * width; a += width / 2000) {
        if (a < first - 0.5 * step || a > last + 0.5 * step)
          left_out += two_way(a, width) * width / 2000;
      }
      EXPECT_LT(left_out / all, 3e-4) << width << " deg, axis at " << part;
    }
  }
}

// Two-way Gaussian beams have an effective clutter width of 0.7527 beam widths (SOURCES.md "Sets");
// the cosine taper's main lobe comes within 2 % of it.
TEST(Beam, EffectiveWidthIsThatOfTheLiterature) {
  double sum = 0.0;
  for (float w : beam_weights(1.2, 8192, 0.0, 40)) sum += static_cast<double>(w) * 360.0 / 8192;
  std::printf("effective two-way width %.4f beam widths\n", sum / 1.2);
  EXPECT_NEAR(sum / 1.2, 0.7527, 0.015);
}

}  // namespace
}  // namespace skerry::echo
