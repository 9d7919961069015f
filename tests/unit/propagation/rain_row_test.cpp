#include "echo/kernel/rain_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

class OnEveryIsa {
 public:
  template <typename Body>
  explicit OnEveryIsa(const Body& body) {
    for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      force_isa(isa);
      body();
    }
    force_isa(best_isa());
  }
};

TEST(RainRow, ACloudIsItsReference) {
  const CloudChord cloud{5000.0f, 300.0f * 300.0f, 2000.0f * 2000.0f, 16.0f};
  std::vector<float> first;
  OnEveryIsa([&] {
    for (std::size_t n : {0u, 1u, 2u, 15u, 16u, 17u, 67u, 512u}) {
      std::vector<float> rates(n, 1.0f);
      add_cloud(cloud, 2900.0f, 8.5f, rates);
      for (std::size_t j = 0; j < n; ++j)
        ASSERT_NEAR(rates[j],
                    1.0 + cloud_rate_reference(cloud, 2900.0 + 8.5 * static_cast<double>(j)), 2e-4);
      if (n == 512) {
        if (first.empty()) first = rates;
        EXPECT_EQ(rates, first);
      }
    }
  });
  EXPECT_EQ(cloud_rate_reference(cloud, 5000.0), 16.0);
  EXPECT_EQ(cloud_rate_reference(cloud, 7001.0), 0.0);
}

TEST(RainRow, LossIsThePowerLaw) {
  std::vector<float> rates, first;
  for (double rate = 1e-5; rate < 300.0; rate *= 1.01) rates.push_back(static_cast<float>(rate));
  rates.insert(rates.end(), {0.0f, 1e-7f, 1e-30f});
  std::vector<float> losses(rates.size());
  double worst = 0.0;
  OnEveryIsa([&] {
    rain_losses(rates, -7.5f, 1.2895f, losses);
    for (std::size_t j = 0; j + 3 < rates.size(); ++j) {
      const double truth = std::exp2(-7.5) * std::pow(static_cast<double>(rates[j]) + 1e-6, 1.2895);
      worst = std::max(worst, std::fabs(static_cast<double>(losses[j]) / truth - 1.0));
    }
    for (std::size_t j = rates.size() - 3; j < rates.size(); ++j) {
      EXPECT_LT(losses[j], 1e-9f);
    }
    if (first.empty()) first = losses;
    EXPECT_EQ(losses, first);
  });
  std::printf("rain loss: %.1e relative at most\n", worst);
  EXPECT_LT(worst, 4e-4);
}

TEST(RainRow, KnotsAreJoinedStraight) {
  for (std::size_t step : {1u, 2u, 4u, 8u, 16u})
    for (std::size_t n = 0; n <= 67; ++n) {
      const std::size_t count = (n + step - 1) / step + 1;
      std::vector<float> knots, row(n + 1, -9.0f);
      for (std::size_t j = 0; j < count; ++j)
        knots.push_back(static_cast<float>((j * j * 37) % 11));
      OnEveryIsa([&] {
        spread_knots(knots, step, std::span(row).first(n));
        for (std::size_t i = 0; i < n; ++i) {
          const double share = static_cast<double>(i % step) / static_cast<double>(step);
          const double a = knots[i / step], b = knots[i / step + 1];
          ASSERT_NEAR(row[i], a + share * (b - a), 1e-5) << step << ' ' << n << ' ' << i;
        }
        ASSERT_EQ(row[n], -9.0f);
      });
    }
}

TEST(RainRow, PowerLeftHalvesWithEveryOctave) {
  OnEveryIsa([] {
    std::vector<float> octaves = {0.0f, 1.0f, 2.5f, 0.001f, 65.9f, 66.0f};
    power_left(octaves);
    const double truth[] = {1.0, 0.5, std::exp2(-2.5), std::exp2(-0.001), std::exp2(-65.9)};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(octaves[i] / truth[i], 1.0, 2e-5);
    EXPECT_EQ(octaves[5], std::ldexp(1.0f, -66));
  });
}

TEST(RainRow, FillsARow) {
  for (std::size_t n : {0u, 1u, 31u, 67u}) {
    std::vector<float> row(n + 1, 2.0f);
    fill_row(0.5f, std::span(row).first(n));
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(row[i], 0.5f);
    EXPECT_EQ(row[n], 2.0f);
  }
}

}  // namespace
}  // namespace skerry::echo
