#include "echo/kernel/relief_noise.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

constexpr std::array<NoiseOctave, 3> kOctaves = {{{900.0, 0.6f}, {130.0, 0.3f}, {21.0, 0.1f}}};

TEST(ReliefNoise, MatchesItsReferenceAlongARay) {
  const LatticePath path{6711345.25, 14.3, -1.1e-4, -297123.75, -20.1, 2.3e-4};
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      std::vector<float> out(n, 9.0f);
      relief_noise(path, kOctaves, 77, 100, out);
      for (std::size_t k = 0; k < n; ++k) {
        const double i = 100.0 + static_cast<double>(k);
        const double exact =
            relief_noise_reference(path.north0 + i * (path.north1 + i * path.north2),
                                   path.east0 + i * (path.east1 + i * path.east2), kOctaves, 77);
        worst = std::max(worst, std::fabs(static_cast<double>(out[k]) - exact));
      }
    }
  });
  std::printf("worst error: %.3g\n", worst);
  EXPECT_LE(worst, 1e-3);
}

TEST(ReliefNoise, GivesTheSameBitsOnEveryInstructionSet) {
  const LatticePath path{-123456.7, 43.4, 1e-3, 987654.3, 12.3, -2e-3};
  std::vector<float> first;
  on_every_isa([&] {
    std::vector<float> out(4001);
    relief_noise(path, kOctaves, 5, 3, out);
    if (first.empty()) first = out;
    EXPECT_EQ(out, first);
  });
}

TEST(ReliefNoise, IsFixedToThePlaceWhicheverRayLooks) {
  // Two rays from different own ships that pass the same place at different cells.
  const LatticePath one{1000.0, 10.0, 0.0, 500.0, 0.0, 0.0};
  const LatticePath two{3000.0, -10.0, 0.0, 500.0, 0.0, 0.0};
  std::vector<float> a(101), b(101);
  relief_noise(one, kOctaves, 1, 50, a);  // north 1500 .. 2500
  relief_noise(two, kOctaves, 1, 50, b);  // north 2500 .. 1500
  for (std::size_t k = 0; k < 101; ++k) EXPECT_NEAR(a[k], b[100 - k], 1e-4);
}

TEST(ReliefNoise, StaysWithinTheSumOfItsAmplitudesAndIsNotFlat) {
  const LatticePath path{0.0, 7.0, 0.0, 0.0, 3.0, 0.0};
  std::vector<float> out(4096);
  relief_noise(path, kOctaves, 8, 0, out);
  float low = 1.0f, high = -1.0f;
  for (float v : out) low = std::min(low, v), high = std::max(high, v);
  EXPECT_GE(low, -1.0f);
  EXPECT_LE(high, 1.0f);
  EXPECT_LT(low, -0.3f);
  EXPECT_GT(high, 0.3f);
}

}  // namespace
}  // namespace skerry::echo
