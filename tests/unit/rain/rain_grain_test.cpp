#include "echo/rain/rain_grain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace skerry::echo {
namespace {

GrainField field_of(std::uint64_t seed, std::uint32_t levels) {
  return {seed, 4, 3, levels, 0.4, 1800.0};
}

TEST(RainGrain, IsItsReference) {
  double worst = 0.0;
  for (const std::uint32_t levels : {1u, 3u, 5u}) {
    const GrainField field = field_of(7, levels);
    const std::vector<float> values = rain_grains(field, 12345.6);
    const std::uint32_t columns = field.columns << levels, rows = field.rows << levels;
    ASSERT_EQ(values.size(), std::size_t{columns} * rows);
    for (std::uint32_t r = 0; r < rows; r += 5) {
      for (std::uint32_t c = 0; c < columns; c += 3) {
        const double value = static_cast<double>(values[std::size_t{r} * columns + c]);
        worst = std::max(worst, std::fabs(value - rain_grain_reference(field, 12345.6, c, r)));
      }
    }
  }
  std::printf("grains: worst error %.2e\n", worst);
  EXPECT_LT(worst, 1e-5);
}

// Over 200 fields: mean 0 within 0.1, variance 1 within 15 % (seven levels have 0.95 of the whole
// series, and the finest ones are spread less).
TEST(RainGrain, HasZeroMeanAndUnitVariance) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (const float v : rain_grains(field_of(seed, 5), 100.0 * static_cast<double>(seed))) {
      sum += static_cast<double>(v);
      squares += static_cast<double>(v) * static_cast<double>(v);
      count += 1.0;
    }
  }
  std::printf("grains: mean %.3f, variance %.3f\n", sum / count, squares / count);
  EXPECT_NEAR(sum / count, 0.0, 0.1);
  EXPECT_NEAR(squares / count, 1.0, 0.15);
}

// Growth and decay: after a tenth of a life a field is nearly what it was; after two lives nothing
// is left of it.  Correlations over 60 fields.
TEST(RainGrain, GrowsAndDecaysOverItsLife) {
  const auto correlation = [](double apart) {
    double product = 0.0, squares = 0.0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      const auto before = rain_grains(field_of(seed, 4), 5000.0);
      const auto after = rain_grains(field_of(seed, 4), 5000.0 + apart);
      for (std::size_t i = 0; i < before.size(); ++i) {
        product += static_cast<double>(before[i]) * static_cast<double>(after[i]);
        squares += static_cast<double>(before[i]) * static_cast<double>(before[i]);
      }
    }
    return product / squares;
  };
  const double soon = correlation(18.0), later = correlation(180.0), half = correlation(900.0),
               gone = correlation(3600.0);
  std::printf(
      "grains: correlation %.3f after 18 s, %.3f after 180 s, %.3f after 900 s, %.3f after "
      "two lives\n",
      soon, later, half, gone);
  EXPECT_GT(soon, 0.97);
  EXPECT_GT(later, 0.7);
  EXPECT_LT(half, 0.7);
  EXPECT_NEAR(gone, 0.0, 0.1);
}

// A grain fades into its successor: no jump where a generation ends.
TEST(RainGrain, GoesSmoothlyFromGenerationToGeneration) {
  const GrainField field = field_of(3, 3);
  auto before = rain_grains(field, 0.0);
  double greatest = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    auto now = rain_grains(field, 1.0 * k);
    for (std::size_t i = 0; i < now.size(); ++i)
      greatest = std::max(greatest, std::fabs(static_cast<double>(now[i] - before[i])));
    before = std::move(now);
  }
  std::printf("grains: greatest change in a second %.4f\n", greatest);
  EXPECT_LT(greatest, 0.02);
}

}  // namespace
}  // namespace skerry::echo
