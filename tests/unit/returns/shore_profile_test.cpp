#include "echo/returns/shore_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace skerry::echo {
namespace {

ShoreState state_of(CoastType type, float height = 0.0f, double level = 0.0,
                    double foreshore = 0.0) {
  return {{type, false, height}, level, foreshore};
}

const ShoreState kAll[] = {state_of(CoastType::unknown),
                           state_of(CoastType::rocky),
                           state_of(CoastType::rocky, 25.0f),
                           state_of(CoastType::artificial),
                           state_of(CoastType::artificial, 7.5f, -2.0),
                           state_of(CoastType::sandy),
                           state_of(CoastType::sandy, 0.0f, -3.0, 150.0),
                           state_of(CoastType::sandy, 0.0f, 2.0, -100.0)};

TEST(ShoreProfile, IsContinuousAndNeverHigherThanItsGreatest) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-1.0, 1.0), away(0.0, 6000.0);
  for (const ShoreState& state : kAll) {
    for (int i = 0; i < 20000; ++i) {
      const double broad = noise(random), fine = noise(random);
      const double inland = i % 2 ? away(random) : 0.1 * away(random);
      const Ground here = ground_behind(state, inland, broad, fine);
      const Ground next = ground_behind(state, inland + 0.01, broad, fine);
      // The steepest of all: roughness of 0.16 and roofs that begin over 20 m.
      ASSERT_LT(std::fabs(next.height_m - here.height_m), 0.01) << inland;
      ASSERT_LT(std::fabs(next.gamma - here.gamma), 1e-3) << inland;
      ASSERT_GE(here.gamma, 0.0);
      ASSERT_LE(here.height_m, greatest_height(state, inland) + 1e-9) << inland;
      ASSERT_LE(here.height_m, greatest_height(state, inland + away(random)) + 1e-9) << inland;
    }
  }
}

TEST(ShoreProfile, AQuayStandsAsHighAsChartedOverTheTide) {
  EXPECT_EQ(face_height(state_of(CoastType::artificial)), 3.0);
  EXPECT_EQ(face_height(state_of(CoastType::artificial, 5.0f)), 5.0);
  EXPECT_EQ(face_height(state_of(CoastType::artificial, 5.0f, -2.0)), 7.0);
  EXPECT_EQ(face_height(state_of(CoastType::artificial, 5.0f, 9.0)), 0.5);  // awash
  EXPECT_EQ(face_height(state_of(CoastType::rocky, 5.0f)), 0.0);
  EXPECT_EQ(ground_behind(state_of(CoastType::artificial, 5.0f), 10.0, 0.7, -0.9).height_m, 5.0);
}

TEST(ShoreProfile, ARockyBankStandsAsHighAsCharted) {
  EXPECT_DOUBLE_EQ(ground_behind(state_of(CoastType::rocky), 0.0, 0.3, 0.3).height_m, 4.0);
  EXPECT_DOUBLE_EQ(ground_behind(state_of(CoastType::rocky, 25.0f), 0.0, 0.3, 0.3).height_m, 25.0);
}

TEST(ShoreProfile, SandRisesOneInFiftyFromTheWaterOfTheMoment) {
  for (const double foreshore : {0.0, 80.0, -60.0}) {
    const ShoreState sand = state_of(CoastType::sandy, 0.0f, -foreshore / 50.0, foreshore);
    for (double d = 0.0; d < 150.0 + foreshore; d += 5.0)
      EXPECT_NEAR(ground_behind(sand, d, 0.5, -0.5).height_m, d / 50.0, 1e-12);
    // 3 m at 150 m above high water, and half of 12 m more 900 m behind it.
    EXPECT_NEAR(ground_behind(sand, 1050.0 + foreshore, 0.0, 0.0).height_m,
                (150.0 + foreshore) / 50.0 + 6.0, 1e-12);
    // Above high water the land is the same land, whatever the tide.
    EXPECT_NEAR(ground_behind(sand, 900.0 + foreshore, 0.5, -0.5).height_m - foreshore / 50.0,
                ground_behind(state_of(CoastType::sandy), 900.0, 0.5, -0.5).height_m, 1e-12);
  }
}

}  // namespace
}  // namespace skerry::echo
