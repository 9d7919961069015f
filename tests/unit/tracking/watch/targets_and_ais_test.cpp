// Ships that radar and AIS both tell of.
#include <gtest/gtest.h>

#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kAlma = 211'000'001, kBerta = 211'000'002;

TEST(TargetsAndAis, OneShipShowsOnceAndHasHerName) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 4.0 * kNm}, 90.0, 10.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 90.0, 10.0);
  sea.go_on_for(30.0);
  ASSERT_EQ(sea.list().targets_size(), 1);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_ACQUIRING);
  EXPECT_EQ(sea.target(1)->mmsi(), kAlma);  // by her place alone
  sea.go_on_for(200.0);
  EXPECT_EQ(sea.target(1)->mmsi(), kAlma);
  EXPECT_EQ(sea.target(1)->name(), "ALMA");
  ASSERT_NE(sea.ais_target(kAlma), nullptr);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 1u);
  wire::TargetOrder apart;
  apart.mutable_rules()->set_associate(false);
  sea.order(apart);
  sea.update();
  EXPECT_EQ(sea.target(1)->mmsi(), 0u);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 0u);
}

TEST(TargetsAndAis, APairHasOneOutcomeOfATrialByAisWhileTheTrackIsYoung) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 4.0 * kNm}, 90.0, 10.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 90.0, 10.0);
  wire::TargetOrder order;
  order.mutable_trial()->set_course_deg(90.0);
  order.mutable_trial()->set_speed_kn(10.0);
  sea.go_on_for(30.0);
  sea.order(order);
  sea.update();
  ASSERT_EQ(sea.ais_target(kAlma)->target(), 1u);
  ASSERT_EQ(sea.list().trial().outcomes_size(), 1);
  EXPECT_EQ(sea.list().trial().outcomes(0).mmsi(), kAlma);
  sea.go_on_for(60.0);
  ASSERT_EQ(sea.list().trial().outcomes_size(), 1);
  EXPECT_EQ(sea.list().trial().outcomes(0).target(), 1u);
}

TEST(TargetsAndAis, AnAlarmEndsWithTheAisTargetThatComesToLieTooFar) {
  WatchedSea sea;
  double off_m = 0.0;  // she is put elsewhere
  const Way way = straight_way({0.0, 4.5 * kNm}, 180.0, 25.0);
  tell_by_ais(
      sea, kAlma,
      [&](double t) {
        return way(t) + PlanePoint{off_m, 0.0};
      },
      180.0, 25.0);
  sea.go_on_for(5.0);
  ASSERT_EQ(sea.alert_numbers(), "3044");
  off_m = 60.0 * kNm;
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.ais_target(kAlma), nullptr);
  EXPECT_EQ(sea.alert_numbers(), "");
}

TEST(TargetsAndAis, TwoShipsShowTwice) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({0.0, 4.0 * kNm}, 90.0, 10.0)}};
  tell_by_ais(sea, kAlma, straight_way({0.0, 4.0 * kNm + 1500.0}, 90.0, 10.0), 90.0, 10.0);
  sea.go_on_for(200.0);
  EXPECT_EQ(sea.target(1)->mmsi(), 0u);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 0u);
}

// The third scenario of association_test: they meet at one place, on opposite courses.
TEST(TargetsAndAis, OnOppositeCoursesTheyAreTwo) {
  WatchedSea sea;
  const double meet_s = 300.0, v = 10.0 * kKnot;
  const PlanePoint at = vector_of(340.0, 4.0 * kNm);
  sea.sea.targets = {{straight_way(at - PlanePoint{v * meet_s, 0.0}, 90.0, 10.0)}};
  tell_by_ais(sea, kAlma, straight_way(at + PlanePoint{v * meet_s, 0.0}, 270.0, 10.0), 270.0, 10.0);
  for (int k = 0; k < 200; ++k) {
    sea.go_on_for(2.5);
    for (const wire::Target& target : sea.list().targets()) EXPECT_EQ(target.mmsi(), 0u);
  }
}

TEST(TargetsAndAis, APairAlarmsOnceAlsoWhenItComesTogether) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 4.5 * kNm}, 180.0, 25.0);
  tell_by_ais(sea, kAlma, way, 180.0, 25.0);
  sea.go_on_for(5.0);
  ASSERT_EQ(sea.alert_numbers(), "3044");  // of AIS alone
  EXPECT_EQ(sea.alert(3044).mmsi(), kAlma);
  EXPECT_TRUE(sea.ais_target(kAlma)->is_activated());
  EXPECT_TRUE(sea.ais_target(kAlma)->is_dangerous());
  wire::TargetOrder sleep;
  sleep.add_let_sleep(kAlma);
  EXPECT_EQ(sea.order(sleep).code(), wire::Reply::REFUSED);
  sea.acknowledge(3044);
  sea.sea.targets = {{way}};
  sea.go_on_for(150.0);
  ASSERT_EQ(sea.target(1)->mmsi(), kAlma);
  ASSERT_EQ(sea.alert_numbers(), "3044");
  EXPECT_EQ(sea.alert(3044).target(), 1u);
  EXPECT_EQ(sea.alert(3044).state(), wire::ALERT_ACKNOWLEDGED);  // still
  EXPECT_TRUE(sea.target(1)->is_dangerous());
}

TEST(TargetsAndAis, APairThatDivergesIsTwoWithoutAnAlarm) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 4.5 * kNm}, 180.0, 25.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 180.0, 25.0);
  sea.go_on_for(120.0);
  ASSERT_EQ(sea.target(1)->mmsi(), kAlma);
  sea.acknowledge(3044);
  // Her AIS begins to tell of a place that drifts off.
  const double from_s = sea.now_s;
  tell_by_ais(
      sea, kAlma,
      [=](double t) {
        return way(t) + PlanePoint{0.0, 8.0 * (t - from_s)};
      },
      180.0, 25.0);
  bool were_two = false;
  for (int k = 0; k < 100; ++k) {
    sea.go_on_for(2.5);
    were_two = were_two || sea.target(1)->mmsi() == 0;
    for (const wire::Alert& alert : sea.list().alerts()) {
      EXPECT_EQ(alert.state(), wire::ALERT_ACKNOWLEDGED);
    }
  }
  EXPECT_TRUE(were_two);
  EXPECT_EQ(sea.alert_numbers(), "3044 3044");
}

TEST(TargetsAndAis, WhatTheRadarLosesAisStillHas) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 4.5 * kNm}, 180.0, 25.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 180.0, 25.0);
  sea.go_on_for(120.0);
  sea.acknowledge(3044);
  sea.sea.targets[0].seen = 0.0;
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.alert_numbers(), "3044 3052");
  EXPECT_EQ(sea.alert(3044).mmsi(), kAlma);
  EXPECT_EQ(sea.alert(3044).state(), wire::ALERT_ACKNOWLEDGED);
  EXPECT_EQ(sea.target(1)->name(), "ALMA");
}

// Heading is lost, position is not: AIS goes on.
TEST(TargetsAndAis, WhatIsFrozenAndDroppedLeavesItsAisTarget) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 5.0 * kNm}, 180.0, 25.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 180.0, 25.0);
  sea.go_on_for(120.0);
  sea.acknowledge(3044);
  sea.has_heading = false;
  sea.go_on_for(50.0);
  EXPECT_EQ(sea.target(1)->mmsi(), kAlma);
  EXPECT_EQ(sea.alert(3044).target(), 1u);
  sea.go_on_for(15.0);
  EXPECT_EQ(sea.list().targets_size(), 0);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 0u);
  EXPECT_EQ(sea.alerts(3044).size(), 1u);
  EXPECT_EQ(sea.alert(3044).mmsi(), kAlma);
  EXPECT_EQ(sea.alert(3044).state(), wire::ALERT_ACKNOWLEDGED);
}

TEST(TargetsAndAis, WhatIsCancelledWhileFrozenLeavesItsAisTarget) {
  WatchedSea sea;
  const Way way = straight_way({0.0, 5.0 * kNm}, 90.0, 10.0);
  sea.sea.targets = {{way}};
  tell_by_ais(sea, kAlma, way, 90.0, 10.0);
  sea.go_on_for(60.0);
  sea.has_heading = false;
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 1u);
  wire::TargetOrder cancel;
  cancel.add_cancel(1);
  EXPECT_EQ(sea.order(cancel).code(), wire::Reply::OK);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.ais_target(kAlma)->target(), 0u);
}

TEST(TargetsAndAis, ASilentOneIsLostIfItWasActivated) {
  WatchedSea sea;
  tell_by_ais(sea, kAlma, straight_way({0.0, 8.0 * kNm}, 90.0, 10.0), 90.0, 10.0);
  tell_by_ais(sea, kBerta, straight_way({0.0, -8.0 * kNm}, 90.0, 10.0), 90.0, 10.0, "BERTA");
  sea.go_on_for(30.0);
  wire::TargetOrder wake;
  wake.add_activate(kAlma);
  sea.order(wake);
  sea.before_update = [](double) {};
  sea.go_on_for(55.0);
  EXPECT_EQ(sea.list().ais_size(), 2);
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.ais_target(kBerta), nullptr);  // asleep: it is left out
  ASSERT_NE(sea.ais_target(kAlma), nullptr);
  EXPECT_TRUE(sea.ais_target(kAlma)->is_lost());
  EXPECT_FALSE(sea.ais_target(kAlma)->has_cpa_nm());
  ASSERT_EQ(sea.alert_numbers(), "3052");
  EXPECT_EQ(sea.alert(3052).mmsi(), kAlma);
  sea.acknowledge(3052);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.list().ais_size(), 0);
  // It comes back, asleep.
  tell_by_ais(sea, kAlma, straight_way({0.0, 8.0 * kNm}, 90.0, 10.0), 90.0, 10.0);
  sea.go_on_for(2.5);
  ASSERT_NE(sea.ais_target(kAlma), nullptr);
  EXPECT_FALSE(sea.ais_target(kAlma)->is_activated());
}

TEST(TargetsAndAis, AZoneActivatesAndWarns) {
  WatchedSea sea;
  tell_by_ais(sea, kAlma, straight_way({0.0, 4.2 * kNm}, 180.0, 20.0), 180.0, 20.0);
  wire::TargetOrder order;
  order.mutable_rules()->set_cpa_nm(0.0);
  wire::TargetZone& zone = *order.add_zones();
  zone.set_number(1);
  zone.set_outer_nm(4.0);
  sea.order(order);
  sea.go_on_for(10.0);
  EXPECT_FALSE(sea.ais_target(kAlma)->is_activated());
  sea.go_on_for(60.0);
  EXPECT_TRUE(sea.ais_target(kAlma)->is_activated());
  ASSERT_EQ(sea.alert_numbers(), "3048");
  EXPECT_EQ(sea.alert(3048).mmsi(), kAlma);
}

TEST(TargetsAndAis, WithoutOwnPositionThereAreNone) {
  WatchedSea sea;
  tell_by_ais(sea, kAlma, straight_way({0.0, 8.0 * kNm}, 90.0, 10.0), 90.0, 10.0);
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.list().ais_size(), 1);
  sea.has_place = false;
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.list().ais_size(), 0);
  EXPECT_NE(sea.list().problem().find("no AIS targets"), std::string::npos);
}

}  // namespace
}  // namespace skerry::server
