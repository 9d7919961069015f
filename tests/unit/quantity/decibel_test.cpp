#include "protocol/quantity/decibel.hpp"

#include <gtest/gtest.h>

#include "tests/unit/quantity/operators.hpp"

namespace skerry {
namespace {

static_assert(!Addable<PowerDbm, PowerDbm>);
static_assert(Addable<PowerDbm, Decibels>);
static_assert(std::is_same_v<decltype(dbm(0) - dbm(0)), Decibels>);
static_assert(std::is_same_v<decltype(dbm(0) + decibels(0)), PowerDbm>);

TEST(Decibels, OfWellKnownRatios) {
  EXPECT_DOUBLE_EQ(Decibels::from_ratio(1).value(), 0);
  EXPECT_DOUBLE_EQ(Decibels::from_ratio(10).value(), 10);
  EXPECT_DOUBLE_EQ(Decibels::from_ratio(1e-4).value(), -40);
  EXPECT_NEAR(Decibels::from_ratio(2).value(), 3.0103, 1e-6);
  EXPECT_NEAR(decibels(3).as_ratio(), 1.995262, 1e-6);
}

TEST(Decibels, AddWhereRatiosMultiply) {
  for (double a = 1e-9; a < 1e9; a *= 7) {
    for (double b = 1e-6; b < 1e6; b *= 11) {
      const Decibels sum = Decibels::from_ratio(a) + Decibels::from_ratio(b);
      ASSERT_NEAR(sum.as_ratio() / (a * b), 1, 1e-12);
      const Decibels difference = Decibels::from_ratio(a) - Decibels::from_ratio(b);
      ASSERT_NEAR(difference.as_ratio() / (a / b), 1, 1e-12);
    }
  }
}

TEST(PowerDbm, IsRelativeToOneMilliwatt) {
  EXPECT_DOUBLE_EQ(PowerDbm::from_watts(1e-3).value(), 0);
  EXPECT_DOUBLE_EQ(PowerDbm::from_watts(1).value(), 30);
  EXPECT_NEAR(PowerDbm::from_watts(25e3).value(), 73.9794, 1e-4);  // a 25 kW magnetron
  EXPECT_NEAR(dbm(-100).in_watts(), 1e-13, 1e-27);
}

TEST(PowerDbm, LevelsDifferByARatio) {
  EXPECT_EQ((dbm(-20) - dbm(-90)).value(), 70);
  EXPECT_EQ((dbm(-90) + decibels(30)).value(), -60);
  EXPECT_EQ((dbm(-90) - decibels(30)).value(), -120);
  EXPECT_LT(dbm(-90), dbm(-20));
}

}  // namespace
}  // namespace skerry
