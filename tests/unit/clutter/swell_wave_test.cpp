#include "echo/clutter/swell_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skerry::echo {
namespace {

constexpr Swell kSwell{2.0, 10.0, 90.0};  // from east: towards the west

TEST(SwellWave, HasTheLengthOfDeepWater) {
  const SwellWave wave(kSwell);
  EXPECT_NEAR(wave.length_m(), 156.1, 0.05);
  EXPECT_FALSE(SwellWave(Swell{0.0, 10.0, 90.0}).any());
}

TEST(SwellWave, TravelsALengthInAPeriod) {
  const SwellWave wave(kSwell);
  const double phase = wave.phase_at({500.0, 20.0}, 3.0);
  const auto same = [&](double other) {
    return std::fabs(other - phase - std::round(other - phase));
  };
  EXPECT_LT(same(wave.phase_at({500.0, 20.0}, 13.0)), 1e-9);
  EXPECT_LT(same(wave.phase_at({500.0 - wave.length_m(), 999.0}, 3.0)), 1e-9);
  // Half a period later the crest is half a length further west.
  EXPECT_LT(same(wave.phase_at({500.0 - 0.5 * wave.length_m(), 20.0}, 8.0)), 1e-9);
}

TEST(SwellWave, KeepsTheMeanAndSaysItsVariance) {
  for (const double height : {0.5, 2.0, 6.0, 15.0}) {
    const SwellWave wave(Swell{height, 8.0, 0.0});
    for (const double psi : {0.002, 0.01, 0.1}) {
      for (const double towards : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
        const auto m = wave.modulation(psi, towards);
        double mean = 0.0, square = 0.0;
        for (int k = 0; k < 720; ++k) {
          const double octaves = m.height * std::cos(2.0 * std::numbers::pi * k / 720.0) - m.mean;
          mean += std::exp2(octaves) / 720.0;
          square += std::exp2(2.0 * octaves) / 720.0;
        }
        EXPECT_NEAR(mean, 1.0, 1e-9);
        EXPECT_NEAR(square - 1.0, m.variance, 1e-9);
        EXPECT_LE(m.height, 2.829);
      }
    }
  }
}

TEST(SwellWave, BrightensTheFacesTurnedToTheRadar) {
  // Steep grazing: no shadow.  A face is turned to the radar where the surface rises away from it:
  // looking upswell, before the crest comes; looking downswell, behind it.
  const SwellWave wave(kSwell);
  for (const double towards : {-1.0, 1.0}) {
    const auto m = wave.modulation(0.5, towards);
    double brightest = -1e9, slope_there = 0.0;
    for (int k = 0; k < 360; ++k) {
      const double turns = k / 360.0;
      const double octaves = m.height * std::cos(2.0 * std::numbers::pi * (turns + m.lead));
      // Height cos(2 pi turns); outwards the phase grows with the sign of `towards`.
      if (octaves > brightest) {
        brightest = octaves;
        slope_there = -std::sin(2.0 * std::numbers::pi * turns) * towards;
      }
    }
    EXPECT_NEAR(slope_there, 1.0, 1e-3);
  }
}

TEST(SwellWave, ShadowsItsTroughsAtLowGrazingOnly) {
  const SwellWave wave(kSwell);  // steepness 0.04
  EXPECT_GT(wave.modulation(0.002, 1.0).height, 1.5 * wave.modulation(0.05, 1.0).height);
  EXPECT_EQ(wave.modulation(0.05, 1.0).height, wave.modulation(0.2, 1.0).height);
  EXPECT_NEAR(wave.modulation(0.002, 0.0).height, 0.0, 1e-12);
}

}  // namespace
}  // namespace skerry::echo
