#include "echo/kernel/azimuth_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

struct Rays {
  std::vector<std::vector<float>> rows;
  std::vector<WeightedRay> weighted;
  Rays(std::size_t count, std::size_t cells, std::uint32_t seed) {
    std::mt19937 random(seed);
    for (std::size_t r = 0; r < count; ++r) {
      rows.emplace_back(cells);
      for (float& p : rows.back()) p = std::exp2(static_cast<float>(random() % 400) * 0.1f);
    }
    for (std::size_t r = 0; r < count; ++r) {
      weighted.push_back({rows[r].data(), static_cast<float>(random() % 1000) * 0.001f});
    }
  }
};

TEST(AzimuthSum, MatchesItsReferenceAtEveryLengthAndRayCount) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t cells = 0; cells <= 67; ++cells) {
      for (std::size_t count = 0; count <= 19; ++count) {
        const Rays rays(count, cells, static_cast<std::uint32_t>(cells * 100 + count));
        std::vector<float> sum(cells, 7.0f);
        std::vector<double> exact(cells);
        sum_rays(rays.weighted, sum);
        sum_rays_reference(rays.weighted, exact);
        for (std::size_t i = 0; i < cells; ++i) {
          if (exact[i] > 0.0)
            worst = std::max(worst, std::fabs(static_cast<double>(sum[i]) / exact[i] - 1.0));
        }
      }
    }
  });
  std::printf("worst relative error: %.3g\n", worst);
  EXPECT_LE(worst, 20 * 6e-8);
}

TEST(AzimuthSum, GivesTheSameBitsOnEveryInstructionSetAndWithoutEmptyRays) {
  Rays rays(35, 1537, 4);
  std::vector<float> zeros(1537, 0.0f);
  std::vector<float> first;
  on_every_isa([&] {
    std::vector<float> sum(1537);
    sum_rays(rays.weighted, sum);
    if (first.empty()) first = sum;
    EXPECT_EQ(sum, first);
  });
  std::vector<WeightedRay> with_empty;
  for (const WeightedRay& ray : rays.weighted) {
    with_empty.push_back({zeros.data(), 0.5f});
    with_empty.push_back(ray);
  }
  std::vector<float> sum(1537);
  sum_rays(with_empty, sum);
  EXPECT_EQ(sum, first);
}

}  // namespace
}  // namespace skerry::echo
