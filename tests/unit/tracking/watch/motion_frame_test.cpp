#include "server/tracking/watch/motion_frame.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

OwnSensors own(bool gnss, bool log) {
  OwnSensors own;
  if (gnss) own.over_ground_mps = PlanePoint{1.0, 5.0};
  if (log) own.through_water_mps = PlanePoint{0.0, 5.0};
  return own;
}
constexpr ReferenceTarget kNone{};

TEST(MotionFrame, GroundIsByPositionsAndWaterByTheLog) {
  const MotionFrame ground = motion_frame(wire::STABILISATION_GROUND, own(true, true), kNone);
  EXPECT_EQ(ground.own_mps, (PlanePoint{1.0, 5.0}));
  EXPECT_EQ(ground.by, "GNSS");
  EXPECT_EQ(ground.problem, "");
  const MotionFrame water = motion_frame(wire::STABILISATION_WATER, own(true, true), kNone);
  EXPECT_EQ(water.own_mps, (PlanePoint{0.0, 5.0}));
  EXPECT_EQ(water.by, "gyro and log");
}

TEST(MotionFrame, NeitherTakesTheOthersPlace) {
  const MotionFrame ground = motion_frame(wire::STABILISATION_GROUND, own(false, true), kNone);
  EXPECT_FALSE(ground.own_mps);
  EXPECT_EQ(ground.by, "");
  EXPECT_NE(ground.problem.find("motion over ground is not known"), std::string::npos);
  const MotionFrame water = motion_frame(wire::STABILISATION_WATER, own(true, false), kNone);
  EXPECT_FALSE(water.own_mps);
  EXPECT_NE(water.problem.find("speed through water is not known"), std::string::npos);
}

TEST(MotionFrame, AReferenceTargetLiesStill) {
  const ReferenceTarget reference{5, true, PlanePoint{-2.0, -4.0}};
  const MotionFrame frame = motion_frame(wire::STABILISATION_GROUND, own(false, true), reference);
  EXPECT_EQ(frame.own_mps, (PlanePoint{2.0, 4.0}));
  EXPECT_EQ(frame.by, "target 5");
  EXPECT_EQ(frame.problem, "");
  // Through water it has no say.
  EXPECT_EQ(motion_frame(wire::STABILISATION_WATER, own(true, true), reference).by, "gyro and log");
}

TEST(MotionFrame, WithoutItsReferenceItIsByPositionsAndSaysSo) {
  const ReferenceTarget lost{5, false, {}};
  const MotionFrame frame = motion_frame(wire::STABILISATION_GROUND, own(true, true), lost);
  EXPECT_EQ(frame.by, "GNSS");
  EXPECT_EQ(frame.problem, "reference target 5 is lost: courses and speeds are by GNSS");
  const MotionFrame nothing = motion_frame(wire::STABILISATION_GROUND, own(false, true), lost);
  EXPECT_FALSE(nothing.own_mps);
  EXPECT_NE(nothing.problem.find("reference target 5 is lost"), std::string::npos);
  // It is there, but frozen: no other source slips in for a while.
  const ReferenceTarget frozen{5, true, {}};
  EXPECT_FALSE(motion_frame(wire::STABILISATION_GROUND, own(true, true), frozen).own_mps);
}

}  // namespace
}  // namespace skerry::server
