#include "echo/artefacts/saturation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "echo/artefacts/minimum_range.hpp"
#include "tests/unit/artefacts/small_rig.hpp"

namespace skerry::echo {
namespace {

TEST(Saturation, RecoversExponentiallyBehindAStrongEcho) {
  const RadarModel model = small_model(1.5);
  const Saturation saturation(model);
  for (const double peak_db : {91.0, 105.0, 120.0, 150.0}) {
    std::vector<float> power(1024, 100.0f);
    power[100] = static_cast<float>(std::pow(10.0, peak_db / 10.0));
    ASSERT_TRUE(saturation.apply({}, power));
    EXPECT_EQ(power[99], 100.0f) << "nothing before it changes";
    EXPECT_EQ(decibels(power[100]), decibels(static_cast<float>(std::pow(10.0, peak_db / 10.0))));
    const double excess = std::min(peak_db - 90.0, 40.0);
    double worst = 0.0;
    for (std::size_t i = 101; i < 1024; ++i) {
      const double metres = static_cast<double>(i - 100) * model.cell_m;
      const double want = excess * std::exp(-metres / (0.5 * 299792458.0 * 1e-6));
      worst = std::max(worst, std::fabs(20.0 - decibels(power[i]) - want));
    }
    EXPECT_LT(worst, 0.022) << peak_db;
  }
}

TEST(Saturation, TheStrongestOfSeveralRules) {
  const Saturation saturation(small_model(1.5));
  std::vector<float> power(1024, 1.0f);
  power[100] = 1e12f;
  power[105] = 1e10f;  // over the level, but weaker than what is still to be recovered from
  ASSERT_TRUE(saturation.apply({}, power));
  EXPECT_LT(power[105], 1e10f);
  std::vector<float> alone(1024, 1.0f);
  alone[100] = 1e12f;
  saturation.apply({}, alone);
  EXPECT_EQ(power[106], alone[106]);
}

TEST(Saturation, KeepsTheBitsBelowTheLevelAndSwitchedOff) {
  const Saturation saturation(small_model());
  std::vector<float> power(1024);
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = static_cast<float>(i) * 9.7e5f;
  const auto before = power;
  EXPECT_FALSE(saturation.apply({}, power));
  EXPECT_EQ(power, before);
  power[3] = 1e14f;
  const auto strong = power;
  Artefacts off;
  off.saturation = false;
  EXPECT_FALSE(saturation.apply(off, power));
  EXPECT_EQ(power, strong);
}

TEST(Saturation, MakesNoDenormals) {
  for (const double nm : {0.125, 1.5, 96.0}) {
    const Saturation saturation(small_model(nm));
    std::vector<float> power(1024, 1e-20f);
    power[0] = 9e29f;
    power[512] = 9e29f;
    saturation.apply({}, power);
    for (const float p : power) EXPECT_TRUE(std::isnormal(p) && p > 0.0f && p < 1e30f);
  }
}

TEST(MinimumRange, IsBlindAndThenRecovers) {
  const RadarModel model = small_model(0.25);
  const MinimumRange minimum(model);
  std::vector<float> power(1024, 1.0f);
  minimum.apply({}, power);
  // c (80 ns + 100 ns) / 2 = 26.98 m.
  EXPECT_EQ(model.blind_cells, static_cast<std::uint32_t>(26.98 / model.cell_m));
  for (std::uint32_t i = 0; i < model.blind_cells; ++i) EXPECT_EQ(power[i], 0.0f);
  for (std::uint32_t i = model.blind_cells; i < 1024; ++i) {
    const double behind = (i + 0.5 - model.blind_cells) * model.cell_m;
    EXPECT_NEAR(-decibels(power[i]), 6.0 * std::exp(-behind / 7.4948), 0.011);
    if (i > model.blind_cells) {
      EXPECT_GE(power[i], power[i - 1]);
    }
  }
  EXPECT_GT(decibels(power[static_cast<std::size_t>(40.0 / model.cell_m)]), -1.2)
      << "a buoy at 40 m is seen";
}

TEST(MinimumRange, SwitchedOffKeepsTheBits) {
  Artefacts off;
  off.minimum_range = false;
  std::vector<float> power(1024, 3.0f);
  MinimumRange(small_model(0.25)).apply(off, power);
  EXPECT_EQ(power, std::vector<float>(1024, 3.0f));
}

}  // namespace
}  // namespace skerry::echo
