#include <gtest/gtest.h>

#include "protocol/quantity/geo_point.hpp"

namespace skerry {
namespace {

TEST(GeoPoint, LongitudeWrapsIntoMinus180To180) {
  EXPECT_EQ(wrapped_longitude(0), 0);
  EXPECT_EQ(wrapped_longitude(179.9), 179.9);
  EXPECT_EQ(wrapped_longitude(180), -180);
  EXPECT_EQ(wrapped_longitude(-180), -180);
  EXPECT_EQ(wrapped_longitude(190), -170);
  EXPECT_EQ(wrapped_longitude(-190), 170);
  EXPECT_EQ(wrapped_longitude(720), 0);
}

TEST(PlanePoint, AddsAsAVector) {
  EXPECT_EQ((PlanePoint{1, 2} + PlanePoint{3, 4}), (PlanePoint{4, 6}));
  EXPECT_EQ((PlanePoint{1, 2} - PlanePoint{3, 5}), (PlanePoint{-2, -3}));
  EXPECT_EQ((PlanePoint{1, 2} * 3), (PlanePoint{3, 6}));
}

}  // namespace
}  // namespace skerry
