#include "echo/kernel/row_resampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

std::vector<float> any_row(std::size_t cells, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> row(cells);
  for (float& v : row) v = std::exp2(static_cast<float>(random() % 600) * 0.1f - 10.0f);
  return row;
}

double at_clamped(const std::vector<float>& row, std::ptrdiff_t i) {
  const auto last = static_cast<std::ptrdiff_t>(row.size()) - 1;
  return static_cast<double>(row[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))]);
}

TEST(RowResampling, FinerCellsLieOnStraightLinesBetweenMiddles) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 1; n <= 67; ++n) {
      const auto in = any_row(n, static_cast<std::uint32_t>(n));
      std::vector<float> out(2 * n);
      double_cells(in, out);
      for (std::size_t i = 0; i < 2 * n; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) / 2.0 - 0.5;
        const auto k = static_cast<std::ptrdiff_t>(std::floor(middle));
        const double share = middle - std::floor(middle);
        const double exact = (1.0 - share) * at_clamped(in, k) + share * at_clamped(in, k + 1);
        worst = std::max(worst, std::fabs(static_cast<double>(out[i]) / exact - 1.0));
      }
    }
  });
  std::printf("worst relative error: %.3g\n", worst);
  EXPECT_LE(worst, 2e-7);
}

TEST(RowResampling, CoarserCellsArePeakOrMeanOfTwo) {
  on_every_isa([&] {
    for (std::size_t n = 1; n <= 67; ++n) {
      const auto in = any_row(2 * n + 1, 9);
      std::vector<float> peak(n), mean(n);
      halve_cells_by_peak(in, peak);
      halve_cells_by_mean(in, mean);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(peak[i], std::max(in[2 * i], in[2 * i + 1]));
        EXPECT_EQ(mean[i], 0.5f * (in[2 * i] + in[2 * i + 1]));
      }
    }
  });
}

TEST(RowResampling, AnyCellsInterpolate) {
  std::vector<float> first;
  on_every_isa([&] {
    const auto in = any_row(100, 4);
    std::vector<std::uint32_t> at;
    std::vector<float> share;
    for (std::uint32_t i = 0; i < 133; ++i) {
      at.push_back(i * 3 / 4 % 99);
      share.push_back(static_cast<float>(i % 4) * 0.25f);
    }
    std::vector<float> out(133);
    interpolate_cells(in, at, share, out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = static_cast<double>(in[at[i]]), b = static_cast<double>(in[at[i] + 1]);
      EXPECT_NEAR(static_cast<double>(out[i]), a + static_cast<double>(share[i]) * (b - a),
                  2e-7 * (a + b));
    }
    if (first.empty()) first = out;
    EXPECT_EQ(out, first);
  });
}

TEST(RowResampling, PeaksAreTheLargestOfThreeCells) {
  std::vector<float> in(500);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>(i * 7919 % 1000);
  std::vector<std::uint32_t> at(300), last(300);
  for (std::uint32_t i = 0; i < 300; ++i) {
    at[i] = static_cast<std::uint32_t>(i * 1.6);
    last[i] = at[i] + i % 3;
  }
  on_every_isa([&] {
    std::vector<float> out(300);
    peak_cells(in, at, last, out);
    for (std::size_t i = 0; i < out.size(); ++i)
      ASSERT_EQ(out[i], std::max({in[at[i]], in[at[i] + 1], in[last[i]]})) << i;
  });
}

}  // namespace
}  // namespace skerry::echo
