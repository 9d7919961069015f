#include "echo/kernel/row_losses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(FastExp2, StaysInItsBound) {
  double worst = 0.0;
  for (int i = -126 * 4096; i <= 126 * 4096; ++i) {
    const float x = static_cast<float>(i) / 4096.0f;
    worst = std::max(worst, std::fabs(double{fast_exp2(x)} / std::exp2(double{x}) - 1.0));
  }
  std::printf("worst relative error %.2e\n", worst);
  EXPECT_LT(worst, double{kFastExp2Error});
  for (int n = -126; n <= 126; ++n) {
    EXPECT_EQ(fast_exp2(static_cast<float>(n)), std::ldexp(1.0f, n));
  }
}

TEST(RowLosses, PeakIsTheGreatestOfAnyLength) {
  on_every_isa([] {
    for (std::size_t n = 0; n < 68; ++n) {
      std::vector<float> row(n);
      float most = 0.0f;
      for (std::size_t i = 0; i < n; ++i) {
        row[i] = static_cast<float>(std::exp2(60.0 * as_unit(mixed(n, i)) - 30.0));
        most = std::max(most, row[i]);
      }
      EXPECT_EQ(peak_of(row), most) << n;
    }
    EXPECT_EQ(peak_of(std::vector<float>(5, 0.0f)), 0.0f);
  });
}

TEST(RowLosses, PeaksAreTheGreatestOfEachBlock) {
  on_every_isa([] {
    for (std::size_t n = 0; n <= 3 * kPeakCells + 17; ++n) {
      std::vector<float> row(n);
      for (std::size_t i = 0; i < n; ++i)
        row[i] = static_cast<float>(std::exp2(60.0 * as_unit(mixed(n, i)) - 30.0));
      std::vector<float> peaks((n + kPeakCells - 1) / kPeakCells);
      const float most = peaks_of(row, peaks);
      EXPECT_EQ(most, peak_of(row)) << n;
      for (std::size_t b = 0; b < peaks.size(); ++b) {
        const std::size_t begin = b * kPeakCells, count = std::min(kPeakCells, n - begin);
        EXPECT_EQ(peaks[b],
                  *std::max_element(row.begin() + static_cast<std::ptrdiff_t>(begin),
                                    row.begin() + static_cast<std::ptrdiff_t>(begin + count)))
            << n << ", " << b;
      }
    }
  });
}

TEST(RowLosses, DyingIsThatOfItsReference) {
  double worst = 0.0;
  std::vector<float> first;
  on_every_isa([&] {
    std::vector<float> all;
    for (const float loss : {0.0f, 0.01f, 3.0f, 13.3f, 100.0f}) {
      for (std::size_t n = 0; n < 68; ++n) {
        std::vector<float> dying(n), power(n);
        std::vector<double> reference(n);
        for (std::size_t i = 0; i < n; ++i) {
          dying[i] = static_cast<float>(as_unit(mixed(i, n)));
          power[i] = static_cast<float>(1.0 + 1e9 * as_unit(mixed(7, i)));
          reference[i] = double{power[i]};
        }
        lose_dying(loss, dying, power);
        lose_dying_reference(loss, dying, reference);
        for (std::size_t i = 0; i < n; ++i)
          worst = std::max(worst, std::fabs(double{power[i]} / reference[i] - 1.0));
        all.insert(all.end(), power.begin(), power.end());
      }
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << "the same bits on every instruction set";
  });
  std::printf("worst relative error %.2e\n", worst);
  EXPECT_LT(worst, 3e-5);
}

TEST(RowLosses, TiltIsThatOfItsReference) {
  double worst = 0.0;
  std::vector<float> first;
  on_every_isa([&] {
    std::vector<float> all;
    for (const double width_deg : {4.0, 22.0, 25.0}) {
      const double width = width_deg * M_PI / 180.0;
      for (const double tilt : {-0.5, -0.17, -0.01, 0.0, 0.02, 0.2, 0.5}) {
        for (std::size_t n = 0; n < 68; ++n) {
          std::vector<float> depression(n), power(n);
          std::vector<double> reference(n);
          for (std::size_t i = 0; i < n; ++i) {
            depression[i] = static_cast<float>(1.57 * as_unit(mixed(i, n)) * as_unit(mixed(i)));
            power[i] = static_cast<float>(1e9 * as_unit(mixed(7, i)));
            reference[i] = double{power[i]};
          }
          const TiltedBeam beam{static_cast<float>(tilt), static_cast<float>(8.0 / (width * width)),
                                -13.3f};
          lose_by_tilt(beam, depression, power);
          lose_by_tilt_reference(beam, depression, reference);
          for (std::size_t i = 0; i < n; ++i) {
            if (reference[i] > 0.0)
              worst = std::max(worst, std::fabs(double{power[i]} / reference[i] - 1.0));
          }
          all.insert(all.end(), power.begin(), power.end());
        }
      }
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << "the same bits on every instruction set";
  });
  std::printf("worst relative error %.2e\n", worst);
  EXPECT_LT(worst, 4e-5);
}

TEST(RowLosses, ABeamThatStandsLevelLosesNothing) {
  std::vector<float> depression{0.0f, 0.01f, 0.3f, 1.2f}, power{1.0f, 2.0f, 3.0f, 4.0f};
  lose_by_tilt({0.0f, 54.0f, -13.3f}, depression, power);
  EXPECT_EQ(power, (std::vector<float>{1.0f, 2.0f, 3.0f, 4.0f}));
}

}  // namespace
}  // namespace skerry::echo
