#include "protocol/quantity/length.hpp"

#include <gtest/gtest.h>

namespace skerry {
namespace {

TEST(Length, NauticalMileIs1852Metres) {
  EXPECT_EQ(nautical_miles(1).in_metres(), 1852);
  EXPECT_EQ(nautical_miles(0.125).in_metres(), 231.5);
  EXPECT_EQ(nautical_miles(96).in_metres(), 177'792);
  EXPECT_EQ(metres(926).in_nautical_miles(), 0.5);
}

TEST(Length, AddsScalesAndCompares) {
  EXPECT_EQ(metres(2) + metres(3), metres(5));
  EXPECT_EQ(metres(2) - metres(3), metres(-1));
  EXPECT_EQ(metres(2) * 3, metres(6));
  EXPECT_EQ(3 * metres(2), metres(6));
  EXPECT_EQ(metres(6) / 3, metres(2));
  EXPECT_EQ(metres(6) / metres(3), 2.0);
  EXPECT_GT(nautical_miles(1), metres(1851));
}

}  // namespace
}  // namespace skerry
