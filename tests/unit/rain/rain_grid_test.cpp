#include "echo/kernel/rain_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

std::vector<float> random_values(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<float> values(count);
  for (float& v : values) v = unit(random);
  return values;
}

// Bound: 2e-4 of the values' range.  A place of up to 512 columns is known to 3e-5 of one, twice
// over; at the far border a value is read 1e-3 of a column early.
TEST(RainGrid, ReadsBetweenValuesAsItsReference) {
  constexpr std::uint32_t kColumns = 512, kRows = 96;
  const std::vector<float> values = random_values(std::size_t{kColumns} * kRows, 1);
  const GridView grid{values.data(), kColumns, kRows};
  std::mt19937_64 random(2);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  double worst = 0.0;
  for (std::size_t n = 0; n < 68; ++n) {
    const GridWalk walk{unit(random) * 480.0f, unit(random) * 80.0f, unit(random) - 0.5f,
                        unit(random) - 0.5f};
    std::vector<float> out(n, 1.0f);
    add_grid(grid, walk, 0.5f, 0.01f, out);
    for (std::size_t j = 0; j < n; ++j) {
      const double at = static_cast<double>(j);
      const double expected =
          1.0 + (0.5 + 0.01 * at) * grid_reference(grid, walk.column + at * walk.more_columns,
                                                   walk.row + at * walk.more_rows);
      worst = std::max(worst, std::fabs(static_cast<double>(out[j]) - expected));
    }
  }
  std::printf("grid: worst error %.6f\n", worst);
  EXPECT_LT(worst, 2e-4);
}

TEST(RainGrid, APlaceOutsideIsTheNearestInside) {
  const std::vector<float> values = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
  const GridView grid{values.data(), 3, 2};
  std::vector<float> out(2, 0.0f);
  add_grid(grid, {-5.0f, -9.0f, 50.0f, 90.0f}, 1.0f, 0.0f, out);
  EXPECT_EQ(out[0], 1.0f);
  EXPECT_NEAR(out[1], 6.0f, 0.01f);
}

TEST(RainGrid, HasTheSameBitsOnEveryInstructionSet) {
  const std::vector<float> values = random_values(64 * 64, 3);
  std::vector<float> first;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    force_isa(isa);
    std::vector<float> row(61, 0.0f);
    add_grid({values.data(), 64, 64}, {3.0f, 60.0f, 0.7f, -0.9f}, 1.0f, 0.1f, row);
    std::vector<float> fine(2 * 62, 0.0f);
    refine_row(std::span(values).first(64), std::span(values).subspan(64, 64), fine);
    add_grain(17, 99, 0.5f, 0.25f, fine);
    row.insert(row.end(), fine.begin(), fine.end());
    raise_row({1.4f, 4.2f, 0.2f}, std::span(values).first(row.size()), row);
    if (first.empty()) first = row;
    EXPECT_EQ(row, first) << name_of(isa);
  }
  force_isa(best_isa());
}

}  // namespace
}  // namespace skerry::echo
