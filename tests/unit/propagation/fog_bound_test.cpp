// Fog is left out of the radar: what it would take from an echo.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace skerry::echo {
namespace {

// Of liquid water in small drops, (dB/km) / (g/m3).  Source: ITU-R P.840-8 section 2, double Debye.
double absorption(double frequency_ghz, double kelvin) {
  const double theta = 300.0 / kelvin;
  const double eps0 = 77.66 + 103.3 * (theta - 1.0), eps1 = 0.0671 * eps0, eps2 = 3.52;
  const double principal_ghz = 20.20 - 146.0 * (theta - 1.0) + 316.0 * std::pow(theta - 1.0, 2.0);
  const double p = frequency_ghz / principal_ghz, s = p / 39.8;
  const double lost = p * (eps0 - eps1) / (1.0 + p * p) + s * (eps1 - eps2) / (1.0 + s * s);
  const double kept = (eps0 - eps1) / (1.0 + p * p) + (eps1 - eps2) / (1.0 + s * s) + eps2;
  const double eta = (2.0 + kept) / lost;
  return 0.819 * frequency_ghz / (lost * (1.0 + eta * eta));
}

// Source: Altshuler 1984, IEEE Trans. AP 32 (7): M = (0.024 / V)^1.54, V in km.
double water_g_m3(double visibility_nm) { return std::pow(0.024 / (1.852 * visibility_nm), 1.54); }

double two_way_db(double frequency_ghz, double visibility_nm, double range_nm) {
  return 2.0 * 1.852 * range_nm * absorption(frequency_ghz, 283.15) * water_g_m3(visibility_nm);
}

TEST(Fog, HoldsAsMuchWaterAsTheRecommendationSays) {
  // P.840 section 2: about 0.05 g/m3 at 300 m, 0.5 g/m3 at 50 m; within a factor of 2.5.
  EXPECT_GT(water_g_m3(0.3 / 1.852), 0.05 / 2.5);
  EXPECT_LT(water_g_m3(0.3 / 1.852), 0.05);
  EXPECT_GT(water_g_m3(0.05 / 1.852), 0.5 / 2.5);
  EXPECT_LT(water_g_m3(0.05 / 1.852), 0.5);
}

TEST(Fog, TakesLessFromAnEchoThanAnybodySees) {
  for (const double visibility_nm : {0.02, 0.05, 0.1, 0.5}) {
    std::printf("fog, %.2f NM of visibility: %.3f g/m3, two ways over 12 NM X %.3f dB, S %.3f dB\n",
                visibility_nm, water_g_m3(visibility_nm), two_way_db(9.4, visibility_nm, 12.0),
                two_way_db(3.05, visibility_nm, 12.0));
  }
  EXPECT_LT(two_way_db(9.4, 0.1, 12.0), 0.15);
  EXPECT_LT(two_way_db(3.05, 0.1, 12.0), 0.02);
  // The densest fog that a scenario may have, and over the whole way.
  EXPECT_LT(two_way_db(9.4, 0.02, 12.0), 1.5);
  EXPECT_LT(two_way_db(3.05, 0.02, 12.0), 0.2);
}

}  // namespace
}  // namespace skerry::echo
