#include <gtest/gtest.h>

#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

struct OneLost : WatchedSea {
  explicit OneLost(double tracked_s, bool with_warnings = true) {
    wire::TargetOrder order;
    order.mutable_rules()->set_lost_warnings(with_warnings);
    this->order(order);
    sea.targets = {{straight_way({3.0 * kNm, 0.0}, 0.0, 10.0)}};
    go_on_for(tracked_s);
    EXPECT_EQ(list().targets_size(), 1);
    sea.targets[0].seen = 0.0;
    go_on_for(60.0);
  }
};

TEST(LostTargets, AreMarkedAndWarnedOfUntilAcknowledged) {
  OneLost sea(120.0);
  ASSERT_EQ(sea.alert_numbers(), "3052");
  ASSERT_NE(sea.target(1), nullptr);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_LOST);
  EXPECT_NEAR(sea.target(1)->range_m(), 3.0 * kNm, 500.0);
  EXPECT_FALSE(sea.target(1)->has_course_deg());
  EXPECT_GT(sea.target(1)->age_s(), 50.0);
  EXPECT_EQ(sea.list().tracked(), 0u);
  sea.go_on_for(600.0);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_LOST);
  EXPECT_EQ(sea.alert(3052).escalations(), 10u);
  EXPECT_EQ(sea.acknowledge(3052, sea.alert(3052).instance()).code(), wire::Reply::OK);
  sea.update();
  EXPECT_EQ(sea.list().targets_size(), 0);
  EXPECT_EQ(sea.alert_numbers(), "");
}

TEST(LostTargets, OnesThatWereHardlyTrackedOrThatNobodyWantsAreNot) {
  EXPECT_EQ(OneLost(30.0).alert_numbers(), "");
  EXPECT_EQ(OneLost(120.0, false).list().targets_size(), 0);
}

TEST(LostTargets, OneThatWasAcquiredByHandIsAlsoWhenYoung) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({3.0 * kNm, 0.0}, 0.0, 10.0)}};
  sea.go_on_for(20.0);
  wire::TargetOrder acquire;
  acquire.mutable_acquire()->set_range_nm(3.0);
  acquire.mutable_acquire()->set_bearing_deg(90.0);
  EXPECT_EQ(sea.order(acquire).text(), "1");
  sea.go_on_for(10.0);
  sea.sea.targets[0].seen = 0.0;
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.alert_numbers(), "3052");
}

TEST(LostTargets, AreLostNoMoreWhenTheyComeOutAgain) {
  OneLost sea(120.0);
  ASSERT_EQ(sea.alert_numbers(), "3052");
  sea.sea.targets[0].seen = 1.0;
  sea.go_on_for(60.0);
  ASSERT_EQ(sea.list().targets_size(), 1) << "once";
  EXPECT_EQ(sea.list().targets(0).number(), 1u);
  EXPECT_EQ(sea.list().targets(0).state(), wire::TARGET_ACQUIRING);
  EXPECT_EQ(sea.alert_numbers(), "");
}

TEST(LostTargets, MayBeCancelled) {
  OneLost sea(120.0);
  wire::TargetOrder cancel;
  cancel.add_cancel(1);
  EXPECT_EQ(sea.order(cancel).code(), wire::Reply::OK);
  sea.update();
  EXPECT_EQ(sea.list().targets_size(), 0);
  EXPECT_EQ(sea.alert_numbers(), "");
}

TEST(LostTargets, ADangerousOneLeavesNoAlarmBehind) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 15.0)}};
  sea.go_on_for(120.0);
  EXPECT_EQ(sea.alert_numbers(), "3044");
  sea.sea.targets[0].seen = 0.0;
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.alert_numbers(), "3052");
}

// Own ship's position leaps: the plotter begins anew, and that is one warning, not one a target.
TEST(LostTargets, ALeapOfPositionIsOneWarning) {
  WatchedSea sea;
  for (int k = 0; k < 8; ++k) {
    sea.sea.targets.push_back({straight_way(vector_of(10.0 + 45.0 * k, 4.0 * kNm), 0.0, 8.0)});
  }
  sea.go_on_for(120.0);
  EXPECT_EQ(sea.list().targets_size(), 8);
  sea.sea.origin.latitude_deg += 0.1;
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.alert_numbers(), "3015");
  EXPECT_EQ(sea.alert(3015).state(), wire::ALERT_RECTIFIED);
  EXPECT_EQ(sea.list().targets_size(), 0);
}

}  // namespace
}  // namespace skerry::server
