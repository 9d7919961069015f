#include "echo/targets/fluctuation.hpp"

#include <gtest/gtest.h>

#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

std::vector<double> sample(Fluctuation kind, std::size_t count) {
  std::vector<double> values;
  for (std::uint64_t k = 0; k < count; ++k)
    values.push_back(static_cast<double>(fluctuation_of(kind, mixed(17, k))));
  return values;
}

TEST(Fluctuation, IsOfItsSwerlingCase) {
  constexpr std::size_t kCount = 200000;
  for (const double v : sample(Fluctuation::steady, 100)) EXPECT_EQ(v, 1.0);
  EXPECT_LT(kolmogorov(sample(Fluctuation::rayleigh, kCount), exponential_law),
            kolmogorov_bound(kCount));
  EXPECT_LT(kolmogorov(sample(Fluctuation::one_dominant, kCount), swerling3_law),
            kolmogorov_bound(kCount));
  // The test can fail: one law is not the other.
  EXPECT_GT(kolmogorov(sample(Fluctuation::rayleigh, kCount), swerling3_law),
            10.0 * kolmogorov_bound(kCount));
}

TEST(Fluctuation, StaysWithinWhatTheHashCanSay) {
  EXPECT_GE(exponential_of(~std::uint64_t{0}), 0.0f);
  EXPECT_LT(exponential_of(~std::uint64_t{0}), 1e-4f);
  EXPECT_NEAR(exponential_of(0), 17.33, 0.01);
  for (std::uint64_t k = 0; k < 100000; ++k) {
    const std::uint64_t hash = mixed(k);
    const double u = (static_cast<double>(hash >> 40) + 0.5) / 16777216.0;
    ASSERT_NEAR(static_cast<double>(exponential_of(hash)), -std::log(u), 8.6e-5) << k;
  }
}

}  // namespace
}  // namespace skerry::echo
