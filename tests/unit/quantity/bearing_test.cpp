#include "protocol/quantity/bearing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/quantity/operators.hpp"

namespace skerry {
namespace {

// Operations that must not compile.
static_assert(!Addable<TrueBearing, TrueBearing>);
static_assert(!Addable<RelativeBearing, RelativeBearing>);
static_assert(!Subtractable<TrueBearing, RelativeBearing>);
static_assert(!std::is_convertible_v<TrueBearing, RelativeBearing>);
static_assert(Addable<TrueBearing, Angle>);

constexpr double kUnit = 360.0 / 4294967296.0;

// The same point on the circle in [0, 360), by the library's fmod.
double on_circle(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360.0 : rest;
}

TEST(Bearing, EverySpokeOfEveryCommonCountComesBack) {
  for (const std::uint32_t count : {1u, 2u, 3u, 250u, 256u, 360u, 720u, 1440u, 2048u, 4095u, 4096u,
                                    8191u, 8192u, 11520u, 65535u, 65536u}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_EQ(TrueBearing::of_spoke(i, count).nearest_spoke(count), i) << "of " << count;
    }
  }
}

TEST(Bearing, SpokesOfEveryCountUpTo65536ComeBack) {
  for (std::uint32_t count = 1; count <= 65536; ++count) {
    for (const std::uint32_t i : {0u, 1u, count / 3, count / 2, count - 1}) {
      ASSERT_EQ(TrueBearing::of_spoke(i, count).nearest_spoke(count), i % count) << "of " << count;
    }
  }
}

TEST(Bearing, All65536AzimuthCountsAreExactUnits) {
  for (std::uint32_t acp = 0; acp < 65536; ++acp) {
    const TrueBearing bearing = TrueBearing::of_spoke(acp, 65536);
    ASSERT_EQ(bearing.units(), acp << 16);
    ASSERT_EQ(TrueBearing::from(degrees(acp * (360.0 / 65536.0))), bearing);
  }
}

TEST(Bearing, WholeDegreesLandInTheirOwnSpokeOf360) {
  for (int d = 0; d < 360; ++d) {
    ASSERT_EQ(TrueBearing::from(degrees(d)).nearest_spoke(360), static_cast<std::uint32_t>(d));
  }
}

TEST(Bearing, NearestSpokeRoundsAndWrapsToZero) {
  EXPECT_EQ(TrueBearing::from(degrees(359.4)).nearest_spoke(360), 359u);
  EXPECT_EQ(TrueBearing::from(degrees(359.6)).nearest_spoke(360), 0u);
  EXPECT_EQ(TrueBearing::from(degrees(0.4)).nearest_spoke(360), 0u);
  EXPECT_EQ(TrueBearing::from(degrees(0.6)).nearest_spoke(360), 1u);
  EXPECT_EQ(TrueBearing::from_units(0xFFFFFFFF).nearest_spoke(8192), 0u);
}

TEST(Bearing, SpokeIndexWrapsWithTheTurn) {
  EXPECT_EQ(TrueBearing::of_spoke(4096, 4096), TrueBearing::of_spoke(0, 4096));
  EXPECT_EQ(TrueBearing::of_spoke(4097, 4096), TrueBearing::of_spoke(1, 4096));
}

TEST(Bearing, IsWithinHalfAUnitOfAnyAngle) {
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double angle = static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63 * 1080;
    const double got = TrueBearing::from(degrees(angle)).in_degrees();
    const double off = std::remainder(got - on_circle(angle), 360.0);
    worst = std::max(worst, std::abs(off));
  }
  RecordProperty("worst_units", std::to_string(worst / kUnit));
  EXPECT_LE(worst, kUnit * 0.5001);
}

TEST(Bearing, JustBelowNorthIsNorthAndNeverATurn) {
  EXPECT_EQ(TrueBearing::from(degrees(-1e-20)).units(), 0u);
  EXPECT_EQ(TrueBearing::from(degrees(360)).units(), 0u);
  EXPECT_EQ(TrueBearing::from(degrees(-360)).units(), 0u);
  EXPECT_LT(TrueBearing::from_units(0xFFFFFFFF).in_degrees(), 360.0);
}

TEST(Bearing, DifferenceIsTheSmallerTurn) {
  const auto difference = [](double a, double b) {
    return (TrueBearing::from(degrees(a)) - TrueBearing::from(degrees(b))).in_degrees();
  };
  EXPECT_NEAR(difference(10, 350), 20, 2 * kUnit);
  EXPECT_NEAR(difference(350, 10), -20, 2 * kUnit);
  EXPECT_NEAR(difference(180, 0), -180, 2 * kUnit);
  EXPECT_NEAR(difference(179, 0), 179, 2 * kUnit);
  EXPECT_NEAR(difference(0, 0), 0, 0);
}

TEST(Bearing, AddingTheDifferenceLeadsThere) {
  std::mt19937 random(2);
  for (int i = 0; i < 100'000; ++i) {
    const auto a = TrueBearing::from_units(static_cast<std::uint32_t>(random()));
    const auto b = TrueBearing::from_units(static_cast<std::uint32_t>(random()));
    ASSERT_EQ(b + (a - b), a);
    ASSERT_EQ(a - (a - b), b);
  }
}

TEST(Bearing, CrossesBetweenFramesByTheHeading) {
  const auto heading = TrueBearing::from(degrees(350));
  const auto over_starboard = RelativeBearing::from(degrees(90));
  EXPECT_NEAR(to_true(over_starboard, heading).in_degrees(), 80, 2 * kUnit);
  std::mt19937 random(3);
  for (int i = 0; i < 10'000; ++i) {
    const auto bow = TrueBearing::from_units(static_cast<std::uint32_t>(random()));
    const auto relative = RelativeBearing::from_units(static_cast<std::uint32_t>(random()));
    ASSERT_EQ(to_relative(to_true(relative, bow), bow), relative);
  }
}

}  // namespace
}  // namespace skerry
