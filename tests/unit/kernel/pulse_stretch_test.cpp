#include "echo/kernel/pulse_stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(PulseStretch, MatchesItsReferenceForEveryPulseLength) {
  std::mt19937 random(11);
  std::vector<float> scratch;
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n : {1u, 2u, 15u, 16u, 17u, 64u, 333u}) {
      for (double cells = 0.2; cells < 140.0; cells *= 1.17) {
        std::vector<float> power(n);
        for (float& p : power)
          p = random() % 3 ? 0.0f : std::exp2(static_cast<float>(random() % 1000) * 0.1f);
        std::vector<double> exact(n);
        stretch_pulse_reference(power, cells, exact);
        stretch_pulse(power, cells, scratch);
        for (std::size_t i = 0; i < n; ++i) {
          if (exact[i] == 0.0) {
            EXPECT_EQ(power[i], 0.0f);
          } else {
            worst = std::max(worst, std::fabs(static_cast<double>(power[i]) / exact[i] - 1.0));
          }
        }
      }
    }
  });
  std::printf("worst relative error: %.3g\n", worst);
  EXPECT_LE(worst, 2e-6);
}

TEST(PulseStretch, APointKeepsItsStartAndFillsThePulse) {
  std::vector<float> power(64, 0.0f), scratch;
  power[10] = 2.0f;
  stretch_pulse(power, 7.25, scratch);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_FLOAT_EQ(power[i], i >= 10 && i < 17 ? 2.0f : i == 17 ? 0.5f : 0.0f) << i;
  }
}

TEST(PulseStretch, AWeakEchoBesideOneOfAHundredDecibelsMoreKeepsItsValue) {
  std::vector<float> power(64, 0.0f), scratch;
  power[3] = 1e10f;
  power[20] = 1.0f;
  stretch_pulse(power, 9.0, scratch);
  EXPECT_EQ(power[20], 1.0f);
  EXPECT_EQ(power[28], 1.0f);
  EXPECT_EQ(power[29], 0.0f);
}

}  // namespace
}  // namespace skerry::echo
