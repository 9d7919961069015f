#include "echo/clutter/gamma_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skerry::echo {
namespace {

TEST(KShape, HasTheVectorsOfTheLaw) {
  EXPECT_NEAR(k_shape(1.0, 1000.0, Polarisation::hh), 0.60954, 0.000005);
  EXPECT_NEAR(k_shape(1.0, 1000.0, Polarisation::vv), 3.05492, 0.000005);
  // 0.95 deg, 80 ns, 1 NM, antenna 15 m.
  EXPECT_NEAR(k_shape(0.464, 368.0, Polarisation::hh), 0.196, 0.0005);
  EXPECT_NEAR(k_shape(0.464, 368.0, Polarisation::vv), 0.981, 0.001);
}

TEST(KShape, IsSpikierAlongTheSwellThanAcross) {
  // The law gives 0.091 along it, beyond the least there is.
  EXPECT_EQ(k_shape_in_swell(0.464, 368.0, Polarisation::hh, 0.0), kLeastShape);
  EXPECT_NEAR(k_shape_in_swell(0.464, 368.0, Polarisation::hh, 90.0), 0.422, 0.001);
  EXPECT_NEAR(k_shape_in_swell(0.464, 368.0, Polarisation::vv, 180.0),
              k_shape(0.464, 368.0, Polarisation::vv) * std::pow(10.0, -1.0 / 3.0), 1e-12);
  EXPECT_NEAR(k_shape_in_swell(0.464, 368.0, Polarisation::hh, 45.0),
              k_shape(0.464, 368.0, Polarisation::hh), 1e-12);
}

TEST(KShape, StaysWithinItsLimitsAndGrazingAngles) {
  EXPECT_EQ(k_shape(0.1, 1.0, Polarisation::hh), kLeastShape);
  EXPECT_EQ(k_shape(10.0, 1e6, Polarisation::vv), kGreatestShape);
  EXPECT_EQ(k_shape(0.01, 5000.0, Polarisation::hh), k_shape(0.1, 5000.0, Polarisation::hh));
  EXPECT_EQ(k_shape(40.0, 500.0, Polarisation::hh), k_shape(10.0, 500.0, Polarisation::hh));
}

}  // namespace
}  // namespace skerry::echo
