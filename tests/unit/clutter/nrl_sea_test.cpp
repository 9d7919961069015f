#include "echo/clutter/nrl_sea.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace skerry::echo {
namespace {

double decibels(double hz, Polarisation polarisation, double psi_deg, double state) {
  return 10.0 * std::log10(sea_reflectivity(hz, polarisation, psi_deg, state));
}

TEST(NrlSea, HasThePublishedVectors) {
  EXPECT_NEAR(decibels(10e9, Polarisation::vv, 1.0, 3.0), -41.189, 0.0005);
  EXPECT_NEAR(sea_reflectivity(30e9, Polarisation::hh, 10.0, 2.0), 2.15552e-4, 0.000005e-4);
}

TEST(NrlSea, HasTheTableOfTheFacts) {
  constexpr double kPsi[] = {0.1, 0.3, 1.0, 3.0};
  constexpr double kX[4][7] = {{-79.56, -69.19, -61.65, -55.69, -50.81, -46.72, -43.25},
                               {-72.24, -61.98, -54.52, -48.64, -43.81, -39.77, -36.35},
                               {-66.48, -56.55, -49.38, -43.74, -39.12, -35.25, -31.98},
                               {-61.40, -52.32, -45.87, -40.82, -36.71, -33.26, -30.34}};
  constexpr double kS[4][7] = {{-92.18, -81.81, -74.27, -68.31, -63.42, -59.34, -55.87},
                               {-83.56, -73.29, -65.83, -59.95, -55.12, -51.09, -47.66},
                               {-75.23, -65.29, -58.13, -52.49, -47.86, -44.00, -40.72},
                               {-67.69, -58.62, -52.17, -47.12, -43.00, -39.56, -36.64}};
  for (int p = 0; p < 4; ++p) {
    for (int state = 0; state <= 6; ++state) {
      EXPECT_NEAR(decibels(9.41e9, Polarisation::hh, kPsi[p], state), kX[p][state], 0.0051);
      EXPECT_NEAR(decibels(3.05e9, Polarisation::hh, kPsi[p], state), kS[p][state], 0.0051);
    }
  }
}

// Nathanson's measurements, dB; 0: none (SOURCES.md "Sea").
constexpr double kGrazing[] = {0.1, 0.3, 1.0, 3.0, 10.0};
struct Measured {
  const char* name;
  double hz;
  Polarisation polarisation;
  double sigma[5][7];
};
constexpr Measured kNathanson[] = {{"9.3 GHz HH",
                                    9.3e9,
                                    Polarisation::hh,
                                    {{0, -71, -59, -53, -48, -42, 0},
                                     {-74, -66, -56, -46, -42, -39, -34},
                                     {-60, -51, -46, -40, -36, -34, -32},
                                     {-58, -50, -43, -39, -35, -33, -30},
                                     {-56, -51, -43, -37, -34, -30, -27}}},
                                   {"9.3 GHz VV",
                                    9.3e9,
                                    Polarisation::vv,
                                    {{0, -65, -56, -51, -48, -44, 0},
                                     {0, -58, -52, -45, -43, -39, -34},
                                     {-60, -50, -44, -39, -37, -33, -31},
                                     {-56, -45, -41, -38, -35, -33, -28},
                                     {-47, -42, -36, -32, -29, -25, -22}}},
                                   {"3 GHz HH",
                                    3e9,
                                    Polarisation::hh,
                                    {{-90, -80, -75, -68, -63, -63, 0},
                                     {-83, -74, -66, -60, -55, -52, -46},
                                     {-75, -66, -55, -48, -45, -42, -41},
                                     {-68, -59, -53, -46, -41, -40, -37},
                                     {0, 0, -51, -46, -40, -38, -37}}},
                                   {"3 GHz VV",
                                    3e9,
                                    Polarisation::vv,
                                    {{0, -80, -75, -75, -67, -63, -56},
                                     {0, -64, -62, -58, -57, -52, 0},
                                     {0, -56, -53, -48, -42, -38, -33},
                                     {0, -52, -49, -43, -38, -35, 0},
                                     {0, -40, -38, -34, -31, -28, -28}}}};

TEST(NrlSea, IsWithinThreeDecibelsOfNathansonInTheMean) {
  for (const Measured& m : kNathanson) {
    double sum = 0.0, signed_sum = 0.0;
    int count = 0;
    for (int p = 0; p < 5; ++p) {
      for (int state = 0; state <= 6; ++state) {
        if (m.sigma[p][state] == 0.0) continue;
        const double off = decibels(m.hz, m.polarisation, kGrazing[p], state) - m.sigma[p][state];
        sum += std::fabs(off);
        signed_sum += off;
        ++count;
      }
    }
    std::printf("%s: mean |error| %.2f dB, bias %.2f dB, %d points\n", m.name, sum / count,
                signed_sum / count, count);
    EXPECT_LE(sum / count, 3.0) << m.name;
  }
}

// Horizontal X band, sea state over 5.5, over 5 deg: the model itself turns, by less than 0.1 dB.
TEST(NrlSea, GrowsWithSeaStateAndGrazingAngle) {
  for (const double hz : {3.05e9, 9.41e9}) {
    for (const Polarisation polarisation : {Polarisation::hh, Polarisation::vv}) {
      for (double psi = 0.1; psi <= 10.0; psi *= 1.1) {
        for (double state = 0.0; state < 5.95; state += 0.1) {
          EXPECT_GT(sea_reflectivity(hz, polarisation, psi, state + 0.1),
                    sea_reflectivity(hz, polarisation, psi, state));
          const bool turns = state > 5.5 && psi > 5.0;
          EXPECT_GT(sea_reflectivity(hz, polarisation, psi * 1.1, state),
                    (turns ? 0.98 : 1.0) * sea_reflectivity(hz, polarisation, psi, state))
              << psi << " deg, sea state " << state;
        }
      }
    }
  }
}

TEST(NrlSea, IsSoundOutsideItsDomain) {
  EXPECT_EQ(sea_reflectivity(9.41e9, Polarisation::hh, 80.0, 3.0),
            sea_reflectivity(9.41e9, Polarisation::hh, 60.0, 3.0));
  EXPECT_EQ(sea_reflectivity(9.41e9, Polarisation::hh, 1.0, 9.0),
            sea_reflectivity(9.41e9, Polarisation::hh, 1.0, 6.0));
  EXPECT_LT(sea_reflectivity(9.41e9, Polarisation::hh, 0.01, 3.0),
            sea_reflectivity(9.41e9, Polarisation::hh, 0.1, 3.0));
  EXPECT_GT(sea_reflectivity(9.41e9, Polarisation::hh, 0.0, 0.0), 0.0);
}

TEST(WindSpread, IsThatOfGitAndKeepsTheMean) {
  const double psi = std::numbers::pi / 180.0;
  const double kDb = 20.0 / std::numbers::ln10;  // exp(a) over exp(-a)
  EXPECT_NEAR(kDb * wind_spread(0.0318589, psi), 5.62, 0.005);
  EXPECT_NEAR(kDb * wind_spread(0.0982926, psi), 3.95, 0.005);
  EXPECT_EQ(wind_spread(0.0318589, 0.4), 0.0);
  for (const double a : {0.1, 0.647, 2.0}) {
    double mean = 0.0;
    for (int k = 0; k < 360; ++k) {
      mean += std::exp(a * std::cos(k * psi)) / bessel_i0(a) / 360.0;
    }
    EXPECT_NEAR(mean, 1.0, 1e-12);
  }
}

TEST(SeaState, RaisesTheWindOfGit) {
  EXPECT_NEAR(wind_of_sea_state(3.0), 3.16 * std::pow(3.0, 0.8), 1e-12);
  EXPECT_EQ(wind_of_sea_state(0.0), 0.0);
}

TEST(Grazing, IsThatOfTheCurvedEarth) {
  EXPECT_NEAR(std::asin(sine_of_grazing(1852.0, 15.0, 8494666.7)) * 180.0 / std::numbers::pi, 0.458,
              0.0005);
  const double horizon = std::sqrt(2.0 * 8494666.7 * 15.0);
  EXPECT_NEAR(sine_of_grazing(horizon, 15.0, 8494666.7), 0.0, 1e-8);
  EXPECT_LT(sine_of_grazing(1.1 * horizon, 15.0, 8494666.7), 0.0);
  EXPECT_EQ(sine_of_grazing(3.0, 15.0, 8494666.7), 1.0);
}

}  // namespace
}  // namespace skerry::echo
