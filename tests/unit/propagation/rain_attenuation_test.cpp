// Numbers of SOURCES.md "Vectors" and "Propagation".
#include "echo/propagation/rain_path.hpp"

#include <gtest/gtest.h>

namespace skerry::echo {
namespace {

void expect_law(double ghz, Polarisation polarisation, double k, double alpha, double k_digit) {
  const RainLaw law = rain_law(ghz * 1e9, polarisation);
  EXPECT_NEAR(law.k, k, 0.51 * k_digit) << ghz;
  EXPECT_NEAR(law.alpha, alpha, 0.51e-5) << ghz;
}

TEST(RainAttenuation, CoefficientsOfTheVectors) {
  expect_law(10.0, Polarisation::hh, 0.012167, 1.25710, 1e-6);
  expect_law(10.0, Polarisation::vv, 0.011292, 1.21565, 1e-6);
  expect_law(9.41, Polarisation::hh, 0.0092994, 1.28951, 1e-7);
  expect_law(9.41, Polarisation::vv, 0.0084048, 1.25666, 1e-7);
  expect_law(3.05, Polarisation::hh, 0.0001371, 1.24807, 1e-7);
  expect_law(3.05, Polarisation::vv, 0.0001989, 1.07495, 1e-7);
}

TEST(RainAttenuation, OfTheRatesThatManualsName) {
  const RainLaw x = rain_law(9.41e9, Polarisation::hh), s = rain_law(3.05e9, Polarisation::hh);
  EXPECT_NEAR(rain_db_per_km(x, 4.0), 0.0556, 0.00005);
  EXPECT_NEAR(rain_db_per_km(x, 16.0), 0.332, 0.0005);
  EXPECT_NEAR(rain_db_per_km(x, 50.0), 1.443, 0.0005);
  EXPECT_NEAR(rain_db_per_km(s, 4.0), 0.0008, 0.00005);
  EXPECT_NEAR(rain_db_per_km(s, 16.0), 0.0044, 0.00005);
  EXPECT_NEAR(rain_db_per_km(s, 50.0), 0.0181, 0.00005);
  // Two-way per mile.
  EXPECT_NEAR(2.0 * 1.852 * rain_db_per_km(x, 4.0), 0.206, 0.0005);
  EXPECT_NEAR(2.0 * 1.852 * rain_db_per_km(x, 16.0), 1.230, 0.0005);
  EXPECT_NEAR(2.0 * 1.852 * rain_db_per_km(x, 50.0), 5.345, 0.0005);
  EXPECT_EQ(rain_db_per_km(x, 0.0), 0.0);
}

}  // namespace
}  // namespace skerry::echo
