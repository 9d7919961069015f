// Ask for a dimension and the variogram of the coast says so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/fractal/dimension.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

constexpr int kCurveDepth = 12, kCurveOctaves = 6;

// Mean over 60 edges of 50 km with all the room there is.  One curve's estimate scatters by 0.019
// at D 1.25 and 0.038 at 1.1 (SOURCES.md "Fractals"), the mean of 60 by 0.005 at most; the folds at
// the walls of the room add 0.01 at the full amplitude.  gamma far from 1 makes steps of log2 gamma
// octaves.
double measured(const CoastStyle& style) {
  const samples::Bridges bridges(style);
  std::vector<double> sum(kCurveOctaves, 0.0);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<double> h =
        bridges.offsets({{0, 0}, {30000, 40000}, mixed(seed, 4), kMaxHalfAngleTan}, kCurveDepth);
    for (int k = 0; k < kCurveOctaves; ++k) {
      sum[static_cast<std::size_t>(k)] += samples::bend_variogram(h, k);
    }
  }
  return samples::dimension_of(sum);
}

TEST(CurveDimension, AskedForIsTheOneTheVariogramSays) {
  for (const CoastMethod method : {CoastMethod::midpoint, CoastMethod::weierstrass}) {
    for (const double amplitude : {0.1, 1.0, 4.0}) {
      std::printf("%-11s amplitude %.1f:", name_of(method).data(), amplitude);
      for (const double d : {1.02, 1.05, 1.1, 1.15, 1.2, 1.3, 1.4, 1.5}) {
        const double got = measured({.method = method, .dimension = d, .amplitude = amplitude});
        std::printf("  %.2f %.3f", d, got);
        EXPECT_NEAR(got, d, amplitude <= 1.0 ? 0.02 : 0.04);
      }
      std::printf("\n");
    }
  }
  for (const double gamma : {1.05, 2.0, 3.0}) {
    std::printf("gamma %.2f:", gamma);
    for (const double d : {1.1, 1.3, 1.5}) {
      const double got =
          measured({.method = CoastMethod::weierstrass, .dimension = d, .gamma = gamma});
      std::printf("  %.2f %.3f", d, got);
      EXPECT_NEAR(got, d, gamma <= 2.0 ? 0.02 : 0.05);
    }
    std::printf("\n");
  }
}

TEST(CurveDimension, OneIsStraight) {
  for (const CoastMethod method : {CoastMethod::regular_koch, CoastMethod::random_koch,
                                   CoastMethod::midpoint, CoastMethod::weierstrass}) {
    std::vector<PlanePoint> out;
    EdgeRefiner({.method = method, .dimension = 1.0, .amplitude = 4.0})
        .refine({{0, 0}, {3000, 0}, 7, kMaxHalfAngleTan}, {.cell_m = 0.1}, out);
    for (const PlanePoint& p : out) EXPECT_NEAR(p.north_m, 0.0, 1e-6);
  }
}

// The same from the vertices the refiner gives, at several bearings (SOURCES.md "Corrections 1").
TEST(CurveDimension, OfWhatTheRefinerGivesIsTheSameAtAllBearings) {
  for (const CoastMethod method : {CoastMethod::midpoint, CoastMethod::weierstrass}) {
    const EdgeRefiner refiner({.method = method, .dimension = 1.25});
    double least = 2.0, most = 1.0;
    for (const double bearing : {0.0, 45.0, 101.25, 135.0, 225.0, 300.0}) {
      const double r = bearing * 0.017453292519943295;
      const PlanePoint to{3000.0 * std::sin(r), 3000.0 * std::cos(r)};
      std::vector<double> sum(kCurveOctaves, 0.0);
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        std::vector<PlanePoint> curve;
        refiner.refine({{0, 0}, to, mixed(seed, 9), kMaxHalfAngleTan}, {.cell_m = 0.1}, curve);
        std::vector<double> h(4097, 1e9);
        for (const PlanePoint& p : curve) {
          const double place = dot(to, p) / dot(to, to) * 4096.0;
          if (std::fabs(place - std::round(place)) > 1e-6) continue;
          h[static_cast<std::size_t>(std::lround(place))] = cross(to, p) / 3000.0;
        }
        for (std::size_t i = 1024; i <= 3072; ++i) ASSERT_LT(h[i], 1e9) << "not made: " << i;
        for (int k = 0; k < kCurveOctaves; ++k) {
          sum[static_cast<std::size_t>(k)] += samples::bend_variogram(h, k);
        }
      }
      const double d = samples::dimension_of(sum);
      least = std::min(least, d);
      most = std::max(most, d);
    }
    std::printf("%s: D %.4f to %.4f\n", name_of(method).data(), least, most);
    EXPECT_NEAR(least, 1.25, 0.03);
    EXPECT_LT(most - least, 0.001);
  }
}

// First differences read a bridge's missing trend as roughness, near D = 1 by up to 0.08: by
// exactly as much as the bridge's covariance says.
TEST(CurveDimension, OfFirstDifferencesIsThatOfTheBridge) {
  for (const double d : {1.02, 1.1, 1.2, 1.35, 1.5}) {
    const samples::Bridges bridges({.method = CoastMethod::midpoint, .dimension = d});
    const FractionalBridge& bridge = bridges.graph().bridge;
    std::vector<double> got(kCurveOctaves, 0.0), want(kCurveOctaves, 0.0);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const std::vector<double> b = bridges.bridge(mixed(seed, 2), kCurveDepth, 0);
      for (int k = 0; k < kCurveOctaves; ++k) {
        got[static_cast<std::size_t>(k)] += samples::step_variogram(b, k);
      }
    }
    for (int k = 0; k < kCurveOctaves; ++k) {
      const double lag = half_to_the(kCurveDepth - k);
      double sum = 0.0;
      for (int i = 0; i < 64; ++i) {
        const double t = 0.25 + (i + 0.5) / 128.0;
        sum += bridge.covariance(t, t) + bridge.covariance(t + lag, t + lag) -
               2.0 * bridge.covariance(t, t + lag);
      }
      want[static_cast<std::size_t>(k)] = sum;
    }
    const double measured_d = samples::dimension_of(got), exact_d = samples::dimension_of(want);
    std::printf("D %.2f: first differences read %.3f, of the exact bridge %.3f\n", d, measured_d,
                exact_d);
    EXPECT_NEAR(measured_d, exact_d, 0.015);
  }
}

// Where the room allows, the middle stands off by the self-similar spread.
TEST(CurveDimension, TheMiddleStandsOffByTheSelfSimilarSpread) {
  for (const CoastMethod method : {CoastMethod::midpoint, CoastMethod::weierstrass}) {
    for (const double d : {1.02, 1.05, 1.1}) {
      // Half the amplitude: little is folded.
      const samples::Bridges bridges({.method = method, .dimension = d, .amplitude = 0.5});
      double squares = 0.0;
      constexpr int kCurves = 2000;
      for (std::uint64_t seed = 0; seed < kCurves; ++seed) {
        const double h =
            bridges.offsets({{0, 0}, {1000, 0}, mixed(seed, 6), kMaxHalfAngleTan}, 1)[1] / 1000.0;
        squares += h * h;
      }
      const double rms = std::sqrt(squares / kCurves), want = 0.5 * self_similar_spread(d);
      std::printf("%s D %.2f: %.4f of the length, wanted %.4f\n", name_of(method).data(), d, rms,
                  want);
      EXPECT_NEAR(rms, want, 0.08 * want);  // four standard errors and the folds
    }
  }
}

}  // namespace
}  // namespace skerry::echo
