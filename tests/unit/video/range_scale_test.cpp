#include "protocol/video/range_scale.hpp"

#include <gtest/gtest.h>

namespace skerry {
namespace {

TEST(RangeScale, ContainsTheScalesTheStandardAsksFor) {
  // MSC.192(79) 5.5
  for (const double nm : {0.25, 0.5, 0.75, 1.5, 3.0, 6.0, 12.0, 24.0}) {
    ASSERT_TRUE(RangeScale::find(nm)) << nm;
    EXPECT_EQ(RangeScale::find(nm)->in_nautical_miles(), nm);
  }
}

TEST(RangeScale, HasTwelveScalesFromAnEighthTo96) {
  EXPECT_EQ(RangeScale::kCount, 12u);
  EXPECT_EQ(RangeScale::from_index(0)->in_nautical_miles(), 0.125);
  EXPECT_EQ(RangeScale::from_index(11)->length().in_metres(), 177'792);
  EXPECT_EQ(RangeScale().in_nautical_miles(), 12);
}

TEST(RangeScale, GrowsWithItsIndexAndComesBackFromIt) {
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const auto scale = RangeScale::from_index(i);
    ASSERT_TRUE(scale);
    EXPECT_EQ(scale->index(), i);
    EXPECT_EQ(RangeScale::find(scale->in_nautical_miles()), scale);
    if (i > 0) {
      EXPECT_GT(scale->length(), RangeScale::from_index(i - 1)->length());
    }
  }
}

TEST(RangeScale, OutsideTheTableCannotBeMade) {
  EXPECT_FALSE(RangeScale::from_index(12));
  for (const double nm : {0.0, -1.0, 0.1, 1.0, 11.999, 12.00001, 95.0, 192.0}) {
    EXPECT_FALSE(RangeScale::find(nm)) << nm;
  }
}

TEST(RangeScale, RingsDivideTheScaleIntoCustomarySteps) {
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    const double nm = scale.in_nautical_miles();
    EXPECT_EQ(scale.ring_count(), nm < 0.3 ? 5 : nm < 3.0 ? 3 : 6) << nm;
  }
}

}  // namespace
}  // namespace skerry
