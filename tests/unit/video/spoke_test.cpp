#include "protocol/video/spoke.hpp"

#include <gtest/gtest.h>

namespace skerry {
namespace {

TEST(SpokeHeader, FirstSpokePointsOverTheBow) {
  SpokeHeader header;
  header.heading = TrueBearing::from(degrees(123));
  EXPECT_EQ(header.bearing(), header.heading);
  EXPECT_EQ(header.antenna().units(), 0u);
}

TEST(SpokeHeader, BearingIsHeadingPlusAntennaAcrossNorth) {
  SpokeHeader header;
  header.geometry.spokes_per_turn = 360;
  header.heading = TrueBearing::from(degrees(350));
  header.index = 30;
  EXPECT_NEAR(header.bearing().in_degrees(), 20, 1e-6);
}

TEST(SpokeHeader, SpokesOfAScanAreEvenlySpacedClockwise) {
  for (const std::uint32_t spokes : {256u, 360u, 2048u, 4095u, 8192u}) {
    SpokeHeader a, b;
    a.geometry.spokes_per_turn = b.geometry.spokes_per_turn = spokes;
    for (std::uint32_t i = 0; i < spokes; ++i) {
      a.index = i;
      b.index = (i + 1) % spokes;
      ASSERT_NEAR((b.antenna() - a.antenna()).in_degrees(), 360.0 / spokes, 2e-7) << i;
    }
  }
}

TEST(SpokeHeader, CellSizeFollowsTheRangeScale) {
  SpokeHeader header;
  header.geometry.cells = 512;
  header.range_scale = *RangeScale::find(6);
  EXPECT_DOUBLE_EQ(header.cell_size().in_metres(), 11'112.0 / 512);
}

}  // namespace
}  // namespace skerry
