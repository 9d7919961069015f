#include "echo/fractal/dimension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/fractal/coast_style.hpp"
#include "echo/fractal/koch_edge.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/coast_picture.hpp"

namespace skerry::echo {
namespace {

TEST(Dimension, OfStraightEdgesIsOneAndGrowsWithTheApex) {
  EXPECT_NEAR(koch_dimension(0.0), 1.0, 1e-6);
  double before = 1.0;
  for (double f = 0.1; f <= kMaxApexFactor; f += 0.1) {
    EXPECT_GT(koch_dimension(f), before);
    before = koch_dimension(f);
  }
  EXPECT_NEAR(koch_dimension(kMaxApexFactor), 1.175, 0.002);
}

TEST(Dimension, AskedForIsTheOneGot) {
  for (double d = 1.01; d < 1.17; d += 0.02) {
    EXPECT_NEAR(koch_dimension(apex_factor_for_dimension(d)), d, 1e-4);
  }
}

TEST(Dimension, GreatestOfEveryMethodCanBeHad) {
  EXPECT_NEAR(
      koch_dimension(apex_factor_for_dimension(greatest_dimension(CoastMethod::random_koch))),
      greatest_dimension(CoastMethod::random_koch), 0.001);
  const double greatest = greatest_dimension(CoastMethod::regular_koch);
  EXPECT_NEAR(regular_koch_dimension(regular_apex_factor_for_dimension(greatest)), greatest, 1e-9);
  EXPECT_NEAR(regular_koch_dimension(kMaxRegularApexFactor), 1.2533, 5e-5);
}

TEST(Dimension, OfRegularKochIsTheClosedForm) {
  // SOURCES.md "Fractals".
  EXPECT_NEAR(regular_koch_dimension(0.8), 1.1812, 5e-5);
  EXPECT_NEAR(regular_koch_dimension(0.95), 1.2407, 5e-5);
  EXPECT_NEAR(regular_koch_dimension(1.0), std::log(4.0) / std::log(3.0), 1e-9);
  for (double d = 1.0; d <= 1.25; d += 0.05) {
    EXPECT_NEAR(regular_koch_dimension(regular_apex_factor_for_dimension(d)), d, 1e-6);
  }
}

TEST(Dimension, SelfSimilarSpreadIsThatOfTheTable) {
  // SOURCES.md "Fractals", Gaussian r.
  const double table[][2] = {{1.02, .0835}, {1.05, .1325}, {1.10, .1877},
                             {1.15, .2295}, {1.20, .2640}, {1.25, .2936},
                             {1.30, .3194}, {1.40, .3626}, {1.50, .3975}};
  for (const auto& [d, spread] : table) EXPECT_NEAR(self_similar_spread(d), spread, 5e-5);
  EXPECT_EQ(self_similar_spread(1.0), 0.0);
}

// The number of pieces a curve needs when all longer than e are split grows as e^-D: measured over
// five octaves of e on 600 curves that are not among the seeds of the expectation.  All pieces are
// about a third as long as their edge, so the growth has steps; edges of lengths spread over a
// factor of three smooth them out.
TEST(Dimension, OfTheDefaultCoastIsAsStated) {
  const Roughness roughness{kMaxHalfAngleTan, apex_factor_for_dimension(CoastStyle{}.dimension)};
  const auto count = [&](auto&& self, const CoastPiece& p, double shortest) -> double {
    const double length = std::hypot(p.to.east_m - p.from.east_m, p.to.north_m - p.from.north_m);
    if (length <= shortest) return 1.0;
    CoastPiece pieces[4];
    split(p, roughness, pieces);
    double sum = 0.0;
    for (const CoastPiece& q : pieces) sum += self(self, q, shortest);
    return sum;
  };
  const auto total = [&](double shortest) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 600; ++i) {
      const double length = std::pow(3.0, -static_cast<double>(i) / 600.0);
      sum += count(count, {{0, 0}, {length, 0}, mixed(0xABCD, i)}, shortest);
    }
    return sum;
  };
  const double d = std::log2(total(0.002 / 32) / total(0.002)) / 5.0;
  std::printf("dimension by counting pieces: %.4f, asked for %.4f\n", d, CoastStyle{}.dimension);
  EXPECT_NEAR(d, CoastStyle{}.dimension, 0.02);
}

}  // namespace
}  // namespace skerry::echo
