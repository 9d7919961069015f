// Heading, position or video is lost for a while.
#include <gtest/gtest.h>

#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

struct TwoTargets : WatchedSea {
  TwoTargets() {
    wire::TargetOrder order;
    wire::TargetZone& zone = *order.add_zones();
    zone.set_number(1);
    zone.set_outer_nm(10.0);
    this->order(order);
    sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 20.0)},
                   {straight_way({4.0 * kNm, 0.0}, 0.0, 5.0)}};
    go_on_for(150.0);
    acknowledge(3048);
    go_on_for(2.5);
  }
};

TEST(FrozenTargets, StayWhereTheyWereAndAgeAndAreTakenUpAgain) {
  TwoTargets sea;
  ASSERT_EQ(sea.alert_numbers(), "3044");
  sea.has_heading = false;
  sea.go_on_for(5.0);
  const double range_m = sea.target(1)->range_m();
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_FROZEN);
  EXPECT_EQ(sea.alert_numbers(), "3044 3015");
  EXPECT_NE(sea.list().problem().find("heading is lost"), std::string::npos);
  sea.go_on_for(30.0);
  EXPECT_EQ(sea.target(1)->range_m(), range_m);
  EXPECT_GT(sea.target(1)->age_s(), 34.0);
  EXPECT_FALSE(sea.target(1)->has_course_deg());
  EXPECT_FALSE(sea.target(1)->has_cpa_nm());
  EXPECT_EQ(sea.alert_numbers(), "3044 3015");  // the alarm stays as it is
  sea.has_heading = true;
  sea.go_on_for(20.0);
  EXPECT_EQ(sea.list().targets_size(), 2);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TRACKED);
  EXPECT_LT(sea.target(1)->range_m(), range_m - 100.0);
  EXPECT_EQ(sea.alert_numbers(), "3044 3015");
  EXPECT_EQ(sea.alert(3015).state(), wire::ALERT_RECTIFIED);
}

TEST(FrozenTargets, AreDroppedAfterAMinuteWithoutAStormOfWarnings) {
  for (const bool place : {false, true}) {
    TwoTargets sea;
    (place ? sea.has_place : sea.has_heading) = false;
    sea.go_on_for(55.0);
    EXPECT_EQ(sea.list().targets_size(), 2);
    sea.go_on_for(10.0);
    EXPECT_EQ(sea.list().targets_size(), 0);
    for (const wire::Alert& alert : sea.list().alerts()) EXPECT_EQ(alert.number(), 3015u);
    sea.go_on_for(60.0);
    sea.has_place = sea.has_heading = true;
    sea.go_on_for(5.0);
    EXPECT_TRUE(sea.alerts(3052).empty());
    sea.go_on_for(40.0);  // acquired anew
    EXPECT_EQ(sea.list().targets_size(), 2);
    EXPECT_TRUE(sea.alerts(3052).empty());
  }
}

TEST(FrozenTargets, OneThatIsNotThereAnyMoreIsLostWithoutAWarning) {
  TwoTargets sea;
  sea.has_heading = false;
  sea.sea.targets[1].seen = 0.0;
  sea.go_on_for(40.0);
  sea.has_heading = true;
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.list().targets_size(), 1);
  EXPECT_TRUE(sea.alerts(3052).empty());
}

TEST(FrozenTargets, WithoutVideoTheyAreFrozenToo) {
  TwoTargets sea;
  for (int k = 0; k < 12; ++k) {
    sea.now_s += 0.5;
    sea.update();
  }
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_FROZEN);
  EXPECT_NE(sea.list().problem().find("no video comes"), std::string::npos);
  EXPECT_EQ(sea.alert_numbers(), "3044");
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TREND);
  EXPECT_EQ(sea.list().problem(), "");
}

TEST(FrozenTargets, WhatWasNeverThereIsNotLost) {
  WatchedSea sea;
  sea.has_heading = sea.has_place = sea.has_gnss = sea.has_log = false;
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.alert_numbers(), "");
  EXPECT_NE(sea.list().problem(), "");
}

}  // namespace
}  // namespace skerry::server
