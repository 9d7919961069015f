#include "echo/propagation/path_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/propagation/radio.hpp"

namespace skerry::echo {
namespace {

constexpr double kFlat = 1e13;  // an Earth as good as flat
constexpr double kPi = std::numbers::pi;

double two_way_db(double power) { return 20.0 * std::log10(power); }

// SOURCES.md "Vectors": F^4 of 15 and 3.5 m at 4.9 NM, flat Earth, perfect mirror.
TEST(SeaReflection, TwoRayFactorOfTheVectors) {
  const ReflectionPath path = reflection_path(4.9 * kMile, 15.0, 3.5, kFlat);
  EXPECT_NEAR(two_way_db(two_ray_power(1.0, path.difference_m, kX)), 10.38, 0.005);
  EXPECT_NEAR(two_way_db(two_ray_power(1.0, path.difference_m, kS)), -5.64, 0.005);
}

// SOURCES.md "Vectors": the lowest lobe falls off beyond 4 h1 h2 / lambda, where the phase is half
// a turn.
TEST(SeaReflection, LastLobeEndsAtTheTransitionRange) {
  EXPECT_NEAR(4.0 * 15.0 * 3.5 / kX / kMile, 3.559, 0.0005);
  EXPECT_NEAR(4.0 * 15.0 * 3.5 / kS / kMile, 1.154, 0.0005);
  const ReflectionPath path = reflection_path(4.0 * 15.0 * 3.5 / kX, 15.0, 3.5, kFlat);
  EXPECT_NEAR(two_way_db(two_ray_power(1.0, path.difference_m, kX)), 12.04, 0.005);
}

TEST(SeaReflection, FarBeyondTheTransitionPointsFallAsTheEighthPower) {
  const auto echo = [](double range) {
    const ReflectionPath path = reflection_path(range, 15.0, 3.5, kFlat);
    return std::pow(two_ray_power(1.0, path.difference_m, kX), 2) / std::pow(range, 4);
  };
  const double r = 20.0 * 4.0 * 15.0 * 3.5 / kX;
  EXPECT_NEAR(std::log2(echo(r) / echo(2.0 * r)), 8.0, 0.02);
}

// SOURCES.md "Propagation", X band, deviation 0.3 m.
TEST(SeaReflection, RoughnessOfTheVectors) {
  const double degrees[] = {0.1, 0.5, 1.0};
  const double ament[] = {0.979, 0.587, 0.119}, miller_brown[] = {0.979, 0.629, 0.297};
  for (int i = 0; i < 3; ++i) {
    const double g = 2.0 * kPi * 0.3 * std::sin(degrees[i] * kPi / 180.0) / kX;
    EXPECT_NEAR(ament_roughness(g), ament[i], 0.0006) << degrees[i];
    EXPECT_NEAR(miller_brown_roughness(g), miller_brown[i], 0.0006) << degrees[i];
  }
}

TEST(SeaReflection, MillerBrownIsTheBesselFunction) {
  double worst = 0.0;
  for (double g = 0.0; g < 8.0; g += 0.01) {
    const double x = 2.0 * g * g;
    const double truth = x < 600.0 ? std::exp(-x) * std::cyl_bessel_i(0.0, x) : 0.0;
    if (x < 600.0) worst = std::max(worst, std::fabs(miller_brown_roughness(g) / truth - 1.0));
  }
  std::printf("Miller-Brown: %.1e relative at most\n", worst);
  EXPECT_LT(worst, 5e-7);
  EXPECT_GT(miller_brown_roughness(1000.0), 0.0);
  EXPECT_GE(ament_roughness(1000.0), 0.0);
}

// Brute force: the mirror is where the way by the surface is shortest.
TEST(SeaReflection, MirrorIsWhereTheWayBySeaIsShortest) {
  for (double h1 : {5.0, 20.0, 60.0})
    for (double h2 : {0.5, 3.5, 20.0, 200.0})
      for (double share : {0.02, 0.3, 0.7, 0.95}) {
        const double d = share * std::sqrt(2.0 * kEarth) * (std::sqrt(h1) + std::sqrt(h2));
        // Long double: the ways differ by millimetres in tens of kilometres.
        const auto way = [&](double x) {
          const long double rest = d - x, drop = static_cast<long double>(x) * x / (2.0L * kEarth);
          const long double far = static_cast<long double>(d) * d / (2.0L * kEarth);
          return std::hypot(static_cast<long double>(x), h1 + drop) +
                 std::hypot(rest, h2 - far + drop);
        };
        double low = 0.0, high = d;
        for (int i = 0; i < 300; ++i) {
          const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
          (way(a) < way(b) ? high : low) = way(a) < way(b) ? b : a;
        }
        const long double far = static_cast<long double>(d) * d / (2.0L * kEarth);
        const long double direct = std::hypot(static_cast<long double>(d), h1 - (h2 - far));
        const double truth = static_cast<double>(way(low) - direct);
        const ReflectionPath path = reflection_path(d, h1, h2, kEarth);
        EXPECT_NEAR(path.difference_m / truth, 1.0, 2e-3) << h1 << ' ' << h2 << ' ' << d;
        EXPECT_NEAR(path.to_mirror_m, low, 2e-3 * d) << h1 << ' ' << h2 << ' ' << d;
        EXPECT_NEAR(path.antenna_m / path.to_mirror_m, path.target_m / (d - path.to_mirror_m),
                    1e-6 * path.sine_of_grazing + 1e-12);
        EXPECT_GT(path.divergence, 0.0);
        EXPECT_LE(path.divergence, 1.0);
      }
}

TEST(SeaReflection, AtTheHorizonTheMirrorIsGone) {
  const double d = 0.99999 * std::sqrt(2.0 * kEarth) * (std::sqrt(20.0) + std::sqrt(5.0));
  const ReflectionPath path = reflection_path(d, 20.0, 5.0, kEarth);
  EXPECT_LT(path.difference_m, 1e-6);
  EXPECT_LT(path.divergence, 0.02);
}

}  // namespace
}  // namespace skerry::echo
