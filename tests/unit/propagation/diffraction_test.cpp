// Numbers of SOURCES.md "Vectors" and "Propagation".
#include "echo/propagation/path_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/propagation/radio.hpp"

namespace skerry::echo {
namespace {

TEST(Diffraction, KnifeEdge) {
  EXPECT_NEAR(knife_edge_loss_db(0.0), 6.03, 0.005);
  EXPECT_NEAR(knife_edge_loss_db(1.0), 13.93, 0.005);
  EXPECT_NEAR(knife_edge_loss_db(2.4), 20.54, 0.005);
  EXPECT_EQ(knife_edge_loss_db(-0.78), 0.0);
  EXPECT_EQ(knife_edge_loss_db(-5.0), 0.0);
  EXPECT_NEAR(knife_edge_loss_db(-0.7799), 0.0, 0.02);
}

TEST(Diffraction, FresnelParameterIsThatOfTheHeightOverTheLine) {
  // h sqrt(2 / lambda (1/d1 + 1/d2))
  EXPECT_NEAR(fresnel_parameter(10.0, 1000.0, 3000.0, 0.03),
              10.0 * std::sqrt(2.0 / 0.03 * 4.0 / 3000.0), 1e-12);
}

TEST(Diffraction, SmoothEarthOf15And10Metres) {
  const double nm[] = {11, 14, 16, 20};
  const double x[] = {0.12, 9.92, 16.58, 30.07}, s[] = {8.57, 15.00, 19.39, 28.36};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(smooth_earth_loss_db(nm[i] * kMile, 15, 10, kX, kEarth), x[i], 0.0055) << nm[i];
    EXPECT_NEAR(smooth_earth_loss_db(nm[i] * kMile, 15, 10, kS, kEarth), s[i], 0.0055) << nm[i];
  }
}

TEST(Diffraction, SmoothEarthCostsMoreFartherLowerAndShorter) {
  for (double nm = 16.0; nm < 60.0; nm += 1.0) {
    const double loss = smooth_earth_loss_db(nm * kMile, 15, 10, kX, kEarth);
    EXPECT_LT(loss, smooth_earth_loss_db((nm + 1.0) * kMile, 15, 10, kX, kEarth));
    EXPECT_LT(loss, smooth_earth_loss_db(nm * kMile, 15, 9, kX, kEarth));
    EXPECT_LT(loss, smooth_earth_loss_db(nm * kMile, 15, 10, kX, 0.9 * kEarth));
  }
}

}  // namespace
}  // namespace skerry::echo
