#include "echo/kernel/range_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(RangeFilter, MatchesItsReference) {
  std::mt19937 random(7);
  std::vector<float> scratch;
  double worst = 0.0;
  on_every_isa([&] {
    for (const std::size_t n : {1u, 15u, 63u, 64u, 65u, 333u}) {
      for (const std::size_t count : {1u, 2u, 17u, 48u}) {
        for (const auto& [tap_cells, lead] : {std::pair{1u, 0u}, {1u, 5u}, {2u, 3u}, {7u, 40u}}) {
          std::vector<float> power(n), taps(count);
          for (float& p : power)
            p = random() % 3 ? 0.0f : std::exp2(static_cast<float>(random() % 1000) * 0.1f);
          for (float& t : taps) t = static_cast<float>(1 + random() % 100) * 0.01f;
          std::vector<double> exact(n);
          filter_range_reference(power, taps, tap_cells, lead, exact);
          filter_range(power, taps, tap_cells, lead, scratch);
          for (std::size_t i = 0; i < n; ++i) {
            if (exact[i] == 0.0) {
              EXPECT_EQ(power[i], 0.0f);
            } else {
              worst = std::max(worst, std::fabs(static_cast<double>(power[i]) / exact[i] - 1.0));
            }
          }
        }
      }
    }
  });
  std::printf("worst relative error: %.3g\n", worst);
  EXPECT_LE(worst, 5e-6);
}

TEST(RangeFilter, AWeakEchoBesideOneOfAHundredDecibelsMoreKeepsItsValue) {
  std::vector<float> power(64, 0.0f), scratch;
  power[3] = 1e10f;
  power[20] = 1.0f;
  filter_range(power, std::vector<float>(9, 1.0f), 1, 0, scratch);
  EXPECT_EQ(power[20], 1.0f);
  EXPECT_EQ(power[28], 1.0f);
  EXPECT_EQ(power[29], 0.0f);
}

TEST(RangeFilter, BeginsBeforeWhatItSpreads) {
  std::vector<float> power(64, 0.0f), scratch;
  power[20] = 1.0f;
  power[63] = 4.0f;
  filter_range(power, std::vector<float>{0.25f, 1.0f, 0.5f}, 1, 1, scratch);
  EXPECT_EQ(power[18], 0.0f);
  EXPECT_EQ(power[19], 0.25f);
  EXPECT_EQ(power[20], 1.0f);
  EXPECT_EQ(power[21], 0.5f);
  EXPECT_EQ(power[22], 0.0f);
  EXPECT_EQ(power[62], 1.0f);
  EXPECT_EQ(power[63], 4.0f);
}

}  // namespace
}  // namespace skerry::echo
